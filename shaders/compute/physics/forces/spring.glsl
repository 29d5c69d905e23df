// The spring between two vertices obeys Hooke's law: F = -k (|x| - L) x / |x|. x runs from one vertex to the other, and L = |x| at rest.
// d is the change of x since rest. With d nothing cancels, so that small strains keep all digits in fp32.
//   |x|^2 - L^2 = d.(2 x - d)   and   (|x| - L) / |x| = (|x|^2 - L^2) / (|x|^2 + |x| L).
#ifndef SPRING_GLSL
#define SPRING_GLSL
#include "../language.glsl"
REAL_BEGIN

// Returns (|x| - L) / |x|. x and d are in a unit near the body's radius. An |x| below about real_epsilon units counts as that long, so
// vertices in one place exert no force on each other. Multiply-adds are written out because a shader compiler does not form them
// where anything later is EXACT.
FN real spring_strain(IN(real3) x, IN(real3) d) {
  const real two = real(2);
  real3 e = real3(FUSED(two, x.x, -d.x), FUSED(two, x.y, -d.y), FUSED(two, x.z, -d.z));
  real growth = FUSED(d.x, e.x, FUSED(d.y, e.y, d.z * e.z));
  real length_squared = FUSED(x.x, x.x, FUSED(x.y, x.y, FUSED(x.z, x.z, real_epsilon * real_epsilon)));
  const real least_square = real_epsilon * real_epsilon;
  real product = max(length_squared * (length_squared - growth), least_square * least_square);  // |x|^2 L^2, rounded to 0 where |x| >> L
  return growth * (real(1) / FUSED(product, inversesqrt(product), length_squared));
}

REAL_END
#endif
