// A body's rigid motion is the one without deformation that has the body's momentum and angular momentum, in its present shape.
// Of all rigid motions it is also the nearest to the vertices' velocities, because every vertex of a body has the same mass.
#ifndef RIGID_MOTION_GLSL
#define RIGID_MOTION_GLSL
#include "language.glsl"
SHARED_BEGIN

// velocity_at() is the velocity at a place.
struct RigidMotion {
  double centre[3];    // [length]
  double velocity[3];  // [m/s]
  double spin[3];      // [m/s per length]
};

// Sums over vertices. The place x of a vertex is relative to that of the body's first one. In stages lengths are in the body's unit, and
// the velocity w is relative to the first vertex's. At a step's start and end lengths are in metres, and w is the velocity itself.
struct Moments {
  double place[3];     // of x
  double velocity[3];  // of w
  double turning[3];   // of x cross w
  double spread[6];    // of the products xx, yy, zz, xy, yz, zx
};

const uint moments_numbers = 15u;

FN Moments no_moments() {
  Moments m;
  STORE3(m.place, 0u, dvec3(0))
  STORE3(m.velocity, 0u, dvec3(0))
  STORE3(m.turning, 0u, dvec3(0))
  STORE3(m.spread, 0u, dvec3(0))
  STORE3(m.spread, 3u, dvec3(0))
  return m;
}

FN void add_vertex(INOUT(Moments) m, dvec3 x, dvec3 w) {
  dvec3 place = LOAD3(m.place, 0u) + x, velocity = LOAD3(m.velocity, 0u) + w, turning = LOAD3(m.turning, 0u) + cross(x, w);
  dvec3 squares = LOAD3(m.spread, 0u) + x * x, products = LOAD3(m.spread, 3u) + dvec3(x.x * x.y, x.y * x.z, x.z * x.x);
  STORE3(m.place, 0u, place)
  STORE3(m.velocity, 0u, velocity)
  STORE3(m.turning, 0u, turning)
  STORE3(m.spread, 0u, squares)
  STORE3(m.spread, 3u, products)
}

FN void add_moments(INOUT(Moments) m, IN(Moments) more) {
  dvec3 place = LOAD3(m.place, 0u) + LOAD3(more.place, 0u), velocity = LOAD3(m.velocity, 0u) + LOAD3(more.velocity, 0u);
  dvec3 turning = LOAD3(m.turning, 0u) + LOAD3(more.turning, 0u);
  dvec3 squares = LOAD3(m.spread, 0u) + LOAD3(more.spread, 0u), products = LOAD3(m.spread, 3u) + LOAD3(more.spread, 3u);
  STORE3(m.place, 0u, place)
  STORE3(m.velocity, 0u, velocity)
  STORE3(m.turning, 0u, turning)
  STORE3(m.spread, 0u, squares)
  STORE3(m.spread, 3u, products)
}

// Returns the spin that gives the angular momentum. Of several it returns the smallest. `squares` and `products` are the spread about
// the centre, in the order of Moments. The inertia J is the spread's trace less the spread.
// If all vertices are in a line, no spin along it does anything. J is then half its own trace across the line, and zero along it. The
// same is taken if vertices are off a line by less than some 1e-6 of its length, because placements in fp32 are rounded to 1e-7.
FN dvec3 least_spin(dvec3 squares, dvec3 products, dvec3 angular_momentum) {
  const double smallest_trace = double(1e-30) * double(1e-30), smallest_determinant = double(1e-13);  // of J over its trace
  double trace = double(2) * ((squares.x + squares.y) + squares.z);
  if (!(trace > smallest_trace)) return dvec3(0);  // a point
  dvec3 spread = squares / trace, off = -products / trace, spin = angular_momentum / trace;
  dvec3 diagonal = dvec3(spread.y + spread.z, spread.z + spread.x, spread.x + spread.y);
  dvec3 cofactors = dvec3(diagonal.y * diagonal.z - off.y * off.y, diagonal.z * diagonal.x - off.z * off.z,
                          diagonal.x * diagonal.y - off.x * off.x);
  dvec3 off_cofactors = dvec3(off.y * off.z - off.x * diagonal.z, off.z * off.x - off.y * diagonal.x,
                              off.x * off.y - off.z * diagonal.y);
  double determinant = (diagonal.x * cofactors.x + off.x * off_cofactors.x) + off.z * off_cofactors.z;
  if (!(determinant > smallest_determinant)) return double(2) * spin;
  return dvec3((cofactors.x * spin.x + off_cofactors.x * spin.y) + off_cofactors.z * spin.z,
               (off_cofactors.x * spin.x + cofactors.y * spin.y) + off_cofactors.y * spin.z,
               (off_cofactors.z * spin.x + off_cofactors.y * spin.y) + cofactors.z * spin.z) / determinant;
}

FN dvec3 velocity_at(IN(RigidMotion) motion, dvec3 place) {
  return LOAD3(motion.velocity, 0u) + cross(LOAD3(motion.spin, 0u), place - LOAD3(motion.centre, 0u));
}

FN RigidMotion rigid_motion_of(dvec3 centre, dvec3 velocity, dvec3 spin) {
  RigidMotion motion;
  STORE3(motion.centre, 0u, centre)
  STORE3(motion.velocity, 0u, velocity)
  STORE3(motion.spin, 0u, spin)
  return motion;
}

// Returns the rigid motion of `count` vertices, or of vertices that weigh as much together. The first one is at `first_place` and has
// `first_velocity`.
FN RigidMotion rigid_motion_with(IN(Moments) m, double count, dvec3 first_place, dvec3 first_velocity) {
  dvec3 place = LOAD3(m.place, 0u), centre = place / count, velocity = LOAD3(m.velocity, 0u) / count;
  dvec3 turning = LOAD3(m.turning, 0u) - cross(place, velocity);
  dvec3 squares = LOAD3(m.spread, 0u) - place * centre;
  dvec3 products = LOAD3(m.spread, 3u) - dvec3(place.x * centre.y, place.y * centre.z, place.z * centre.x);
  return rigid_motion_of(first_place + centre, first_velocity + velocity, least_spin(squares, products, turning));
}

SHARED_END
#endif
