// The paper's damping is F_D = -g m v, with the rate g [1/s]. decay() is its exact action on a kick.
#ifndef DAMPING_GLSL
#define DAMPING_GLSL
#include "language.glsl"
SHARED_BEGIN

const uint damping_none = 0u;
const uint damping_constant = 1u;  // the paper's equation 2
const uint damping_adaptive = 2u;  // the paper's equation 3

// Several kernels have to find the same bits, so each operation rounds by itself.

// Returns the rate g [1/s]: 0, c/m, or min(|F_s| / 10, 10) c/m. `damping` is c [kg/s], `inverse_mass` is 1/m [1/kg], and
// `force_squared` is the square of the net spring force F_s [N^2].
FN double damping_rate(uint law, double damping, double inverse_mass, double force_squared) {
  if (law == damping_none || damping == double(0)) return double(0);
  EXACT double constant = damping * inverse_mass;
  if (law == damping_constant) return constant;
  // GLSL reads literals as fp32. Square roots and divisions are slow on GPUs, but compilers fold these two constants.
  const double tiny = double(1e-30) * double(1e-30), tenth = double(1) / double(10);
  EXACT double force = force_squared * inversesqrt(max(force_squared, tiny));
  EXACT double rate = min(tenth * force, double(10)) * damping * inverse_mass;
  return rate;
}

// What a kick of duration t does, with z = g t. `keep` = e^-z is what it leaves of the velocity. `gain` = phi(z) = (1 - e^-z) / z is
// its effect per acceleration and time. GLSL has no exp of double. A Taylor series serves near zero. Doublings do the rest:
// e^-2z = (e^-z)^2 and phi(2z) = phi(z) (1 + e^-z) / 2.
struct Decay { double keep; double gain; };

FN Decay decay(double z) {
  Decay result;
  if (z == double(0)) {  // the series gives the same, but takes longer
    result.keep = double(1);
    result.gain = double(1);
    return result;
  }
  uint doublings = 0u;
  double y = z;
  while (abs(y) > double(0.25) && doublings < 12u) {
    y = y * double(0.5);
    ++doublings;
  }
  if (abs(y) > double(0.25)) {  // z beyond 1000: e^-z is zero in fp64
    result.keep = double(0);
    result.gain = double(1) / z;
    return result;
  }
  // Divisions are slow on GPUs, but compilers fold these constants.
#define TERM(n) EXACT double term##n = double(1) - (double(1) / double(n)) * y * result.gain; result.gain = term##n;
  result.gain = double(1);
  // for smaller y these change the gain by less than y^7 / 8! = 6e-18
  if (abs(y) > double(1) / double(64)) { TERM(13) TERM(12) TERM(11) TERM(10) TERM(9) TERM(8) }
  TERM(7) TERM(6) TERM(5) TERM(4) TERM(3) TERM(2)
#undef TERM
  EXACT double left = double(1) - y * result.gain;
  result.keep = left;
  for (uint k = 0u; k < doublings; ++k) {
    EXACT double gain = result.gain * (double(1) + result.keep) * double(0.5);
    EXACT double keep = result.keep * result.keep;
    result.gain = gain;
    result.keep = keep;
  }
  return result;
}

SHARED_END
#endif
