// The spring between two vertices, Hooke's law: F = -k (|x| - L) x / |x| with x = b + d, b the rest vector, L = |b|, and d the
// change of x. Written without cancellation, so that small strains keep all digits in fp32:
//   |x|^2 - L^2 = d.(2 b + d)   and   (|x| - L) / |x| = (|x|^2 - L^2) / (|x|^2 + |x| L).
#ifndef SPRING_GLSL
#define SPRING_GLSL
#include "../language.glsl"
REAL_BEGIN

// (|x| - L) x / |x| [m]: the spring's elongation as a vector, at most L long while it is compressed. Where x or b is zero and has
// no direction it is zero; below 1e-12 L it falls to zero with x.
FN real3 spring_elongation(real3 b, real3 d) {
  real3 x = b + d;
  real growth = (d.x * (b.x + x.x) + d.y * (b.y + x.y)) + d.z * (b.z + x.z);
  real rest_squared = (b.x * b.x + b.y * b.y) + b.z * b.z;
  real length_squared = (x.x * x.x + x.y * x.y) + x.z * x.z;  // not rest_squared + growth, which cancels under compression
  real scale = max(length_squared + sqrt(length_squared * rest_squared), real(1e-12) * rest_squared);
  return (growth / max(scale, real(1e-37))) * x;
}

REAL_END
#endif
