// A closed surface has the pressure p inside and none outside. A vertex at x feels the force F = p dV/dx. By the divergence theorem the
// volume V is the sum of a.(b x c) / 6 over the surface's triangles, wherever the origin is.
#ifndef PRESSURE_GLSL
#define PRESSURE_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct Pressure {      // of a body
  double at_rest;      // p0, at the rest volume [Pa], 0 if there is no pressure
  double rest_volume;  // V0 [m^3]
  uint is_gas;         // 1: p = p0 V0 / V, an ideal gas at one temperature. 0: p = p0
  uint first_part;     // the body's first part in `volume_part`
  uint part_count;
  uint padding;
};

// What a triangle adds to the volume, and to the volume's derivative by its corner a. Corners are counter-clockwise seen from outside.
FN double volume_below(IN(dvec3) a, IN(dvec3) b, IN(dvec3) c) { return dot(a, cross(b, c)) / double(6); }
FN dvec3 volume_gradient(IN(dvec3) a, IN(dvec3) b, IN(dvec3) c) { return cross(b - a, c - a) / double(6); }

// Returns the pressure [Pa] at a volume [m^3]. A body that is turned inside out has no pressure to speak of. The result then moves its
// vertices beyond all numbers, so that the step goes non-finite.
FN double pressure_at(IN(Pressure) p, double volume) {
  const double beyond = double(1e38f) * double(1e38f);
  if (!(volume > double(0))) return beyond;
  return p.is_gas != 0u ? p.at_rest * (p.rest_volume / volume) : p.at_rest;
}

SHARED_END
#endif
