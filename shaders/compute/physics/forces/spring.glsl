// The spring between two vertices, Hooke's law: F = -k (|x| - L) x / |x| with x = b + d, b the rest vector, L = |b|, and d the
// change of x. Written without cancellation, so that small strains keep all digits in fp32:
//   |x|^2 - L^2 = d.(2 b + d)   and   (|x| - L) / |x| = (|x|^2 - L^2) / (|x|^2 + |x| L).
#ifndef SPRING_GLSL
#define SPRING_GLSL
#include "../language.glsl"
REAL_BEGIN

// (|x| - L) x / |x| [m]: the spring's elongation as a vector. Zero where b or x is zero.
FN real3 spring_elongation(real3 b, real3 d) {
  real growth = (d.x * (b.x + b.x + d.x) + d.y * (b.y + b.y + d.y)) + d.z * (b.z + b.z + d.z);
  real rest_squared = (b.x * b.x + b.y * b.y) + b.z * b.z;
  real length_squared = max(rest_squared + growth, real(0));
  real ratio = growth / max(length_squared + sqrt(length_squared * rest_squared), real(1e-37));
  return ratio * (b + d);
}

REAL_END
#endif
