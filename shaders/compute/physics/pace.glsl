// How long steps are where a tolerance governs them. A proportional-integral controller: Gustafsson, ACM Trans. Math. Softw. 17
// (1991) 533-554; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4 and II.5 (dop853's estimate).
#ifndef PACE_GLSL
#define PACE_GLSL
#include "language.glsl"
SHARED_BEGIN
#ifdef __cplusplus
using std::pow, glm::clamp;
#endif

// What became of a step.
const uint step_accepted = 0u;
const uint step_rejected = 1u;  // its error was too large: it is undone
const uint step_empty = 2u;     // none was made, the target being reached
const uint run_over = 3u;       // none will be made any more

struct Pace {
  double time;            // that the state stands at [s]
  double target;          // where a step is to end exactly [s]
  double allowed;         // length of the next step, before it is fitted to the target [s]
  double tolerance;       // of a step's error
  double first_step;      // at the start and after a contact [s]
  double largest_step;    // [s]
  double error_before;    // of the latest step that was not cut short, in units of the tolerance
  double smallest_taken;  // of the steps that were accepted [s]
  double largest_taken;   // likewise [s]
  uint estimate[2];       // this step's errors by the method's two estimates, the largest over all vertices; bits of floats
  uint estimate_order;    // the error grows with this power of the step
  uint verdict;           // on the latest step
  uint accepted;          // steps, so far
  uint rejected;          // likewise
  uint retries;           // 1: the step before was rejected
  uint contact_steps;     // as many as were known when the latest step was judged
};

// Shorter than this no step is tried again: its end would be lost in the time's rounding, or nothing helps.
FN double shortest_step(IN(Pace) pace) { return double(1e-14) * max(pace.time, pace.first_step); }

// A step of the allowed length, or one that ends at the target; what is left over is shared by two, so that no sliver remains.
FN double fitted_step(double allowed, double left) {
  if (!(left > double(0))) return double(0);
  if (left <= allowed) return left;
  return left < double(2) * allowed ? left * double(0.5) : allowed;
}

// A contact breaks the motion off: errors from before say nothing for a longer step than the first.
FN double allowed_step(IN(Pace) pace, uint contact_steps) {
  return contact_steps == pace.contact_steps ? pace.allowed : min(pace.allowed, pace.first_step);
}

FN double next_step(IN(Pace) pace, uint contact_steps) {
  return fitted_step(allowed_step(pace, contact_steps), pace.target - pace.time);
}

// Steps are meant to have this error, in units of the tolerance: so far below it that few are rejected.
FN double aimed_error() { return double(2) / double(5); }

FN void start_anew(INOUT(Pace) pace, uint contact_steps) {
  pace.allowed = allowed_step(pace, contact_steps);
  pace.contact_steps = contact_steps;
  pace.error_before = aimed_error();
  pace.retries = 0u;
}

// In units of the tolerance, from two estimates e and f as bits of floats: e^2 / sqrt(e^2 + f^2 / 100), as in dop853. NaN counts as
// infinite; by bits, because shader compilers turn comparisons round as if there were no NaN.
FN double judged_error(uint e_bits, uint f_bits, double tolerance) {
  const uint infinite = 0x7f800000u;
  if (max(e_bits, f_bits) >= infinite) return double(1e30);
  double e = double(uintBitsToFloat(e_bits)), f = double(uintBitsToFloat(f_bits));
  if (e == double(0)) return double(0);
  return e * e / (sqrt(e * e + f * f / double(100)) * tolerance);
}

// By what factor the next step may be longer than one with this error. GLSL has powers of floats alone.
FN double power_of_error(double error, float exponent) {
  double relative = max(error, double(1e-10)) / aimed_error();
  return double(pow(float(relative), exponent));
}

FN double after_acceptance(IN(Pace) pace, double error) {
  float k = float(pace.estimate_order);
  double factor = power_of_error(error, -0.7f / k) * power_of_error(pace.error_before, 0.4f / k);
  return clamp(factor, double(1) / double(3), double(6));
}

FN double after_rejection(IN(Pace) pace, double error) {
  return max(power_of_error(error, -1.0f / float(pace.estimate_order)), double(1) / double(3));
}

FN void accept_step(INOUT(Pace) pace, double taken, double error) {
  double allowed = taken * after_acceptance(pace, error);
  if (pace.retries != 0u) allowed = min(allowed, taken);
  if (taken < pace.allowed)
    allowed = max(allowed, pace.allowed);  // it was cut short, and its small error is no reason for short steps
  else
    pace.error_before = max(error, double(1e-4));
  pace.allowed = min(allowed, pace.largest_step);
  pace.time = taken == pace.target - pace.time ? pace.target : pace.time + taken;
  pace.smallest_taken = pace.accepted == 0u ? taken : min(pace.smallest_taken, taken);
  pace.largest_taken = max(pace.largest_taken, taken);
  pace.accepted += 1u;
  pace.retries = 0u;
  pace.verdict = step_accepted;
}

FN void reject_step(INOUT(Pace) pace, double taken, double error) {
  pace.allowed = max(taken * after_rejection(pace, error), shortest_step(pace));
  pace.rejected += 1u;
  pace.retries = 1u;
  pace.verdict = step_rejected;
}

// Decides on a step of the length `taken`, and how long the next may be. The shortest step stands whatever its error, for the run
// ends with it.
FN void judge(INOUT(Pace) pace, double taken) {
  double error = judged_error(pace.estimate[0], pace.estimate[1], pace.tolerance);
  if (error <= double(1) || taken <= shortest_step(pace))
    accept_step(pace, taken, error);
  else
    reject_step(pace, taken, error);
  pace.estimate[0] = 0u;
  pace.estimate[1] = 0u;
}

SHARED_END
#endif
