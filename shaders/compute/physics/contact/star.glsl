// A closed surface of a sphere's kind does not meet itself if it is a star: all of its triangles turn their outsides away from one place
// inside. Seen from there it covers each direction once. So one sign for each triangle stands for all pairs of triangles.
// What surrounds the place once does so while all signs stay, however the surface moves. This needs a surface that does not meet itself at
// the start.
#ifndef STAR_GLSL
#define STAR_GLSL
#include "../language.glsl"
REAL_BEGIN

// Corners of a triangle at a step's start and at its end, relative to the place. All go straight.
struct Facet {
  real3 start[3];
  real3 end[3];
};

// Six times the volume between the place and a triangle, positive if its corners go counter-clockwise seen from outside.
FN real triple_product(IN(real3) a, IN(real3) b, IN(real3) c) { return dot(a, cross(b, c)); }

FN real sum_of_sizes_of(IN(real3) p) { return (abs(p.x) + abs(p.y)) + abs(p.z); }

// Whether the triangle turns its outside away from the place all the time. `winding` is -1 if its corners go clockwise seen from outside,
// and else 1. The volume is a cubic of time. It is positive if its four coefficients in the Bernstein basis are. A volume of corners of this
// size errs by at most 32 roundings of its cube, and a sum of three of them by thrice that. `off` is how far positions in the world may be
// off by rounding [m].
FN bool faces_out(IN(Facet) f, real winding, real off) {
  real size = real(0);
  for (int k = 0; k < 3; ++k) size = max(size, max(sum_of_sizes_of(f.start[k]), sum_of_sizes_of(f.end[k])));
  real margin = (real(32) * real_epsilon * size + real(3) * off) * (size * size);
  real first = triple_product(f.start[0], f.start[1], f.start[2]), last = triple_product(f.end[0], f.end[1], f.end[2]);
  real second = triple_product(f.end[0], f.start[1], f.start[2]) + triple_product(f.start[0], f.end[1], f.start[2]) +
                triple_product(f.start[0], f.start[1], f.end[2]);
  real third = triple_product(f.start[0], f.end[1], f.end[2]) + triple_product(f.end[0], f.start[1], f.end[2]) +
               triple_product(f.end[0], f.end[1], f.start[2]);
  return winding * first > margin && winding * last > margin && winding * second > real(3) * margin &&
         winding * third > real(3) * margin;
}

// Whether the place is deeper than this below the triangle's plane.
FN bool is_deep_below(IN(real3) a, IN(real3) b, IN(real3) c, real winding, real depth) {
  return winding * triple_product(a, b, c) > depth * length(cross(b - a, c - a));
}

REAL_END
#endif
