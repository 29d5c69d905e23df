// Pressure inside a closed surface, nothing outside: F = p dV/dx. The volume V of a closed surface is the sum over its triangles of
// a.(b x c) / 6, wherever the origin is.
#ifndef PRESSURE_GLSL
#define PRESSURE_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct Pressure {      // of a body
  double at_rest;      // p0, at the rest volume [Pa]; 0: there is none
  double rest_volume;  // V0 [m^3]
  uint is_gas;         // 1: p = p0 V0 / V, an ideal gas at one temperature; 0: p = p0
  uint first_part;     // where the volume is summed in parts
  uint part_count;
  uint padding;
};

// What a triangle adds to the volume, and to the volume's derivative by its corner a.
FN double volume_below(IN(dvec3) a, IN(dvec3) b, IN(dvec3) c) { return dot(a, cross(b, c)) / double(6); }
FN dvec3 volume_gradient(IN(dvec3) a, IN(dvec3) b, IN(dvec3) c) { return cross(b - a, c - a) / double(6); }

// [Pa]. A body that is turned inside out has no pressure to speak of: what comes out moves its vertices beyond all numbers, so that the
// step goes non-finite.
FN double pressure_at(IN(Pressure) p, double volume) {
  const double beyond = double(1e38f) * double(1e38f);
  if (!(volume > double(0))) return beyond;
  return p.is_gas != 0u ? p.at_rest * (p.rest_volume / volume) : p.at_rest;
}

SHARED_END
#endif
