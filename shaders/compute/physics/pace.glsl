// How long steps are where a tolerance governs them. A proportional-integral controller: Gustafsson, ACM Trans. Math. Softw. 17
// (1991) 533-554; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4 and II.5 (dop853's estimate).
#ifndef PACE_GLSL
#define PACE_GLSL
#include "collision/box.glsl"
SHARED_BEGIN
#ifdef __cplusplus
using std::pow, glm::clamp;
#endif

// What became of a step.
const uint step_accepted = 0u;
const uint step_rejected = 1u;  // its error was too large, or its contacts too deep: it is undone
const uint step_empty = 2u;     // none was made, the target being reached
const uint run_over = 3u;       // none will be made any more

// Why a step ends the run.
const uint no_failure = 0u;
const uint no_length_meets = 1u;  // its error is too large, and shorter steps do not help
const uint too_many_steps = 2u;   // steps of the length that errors have come to would be more than a run may have

struct Pace {
  double time;            // that the state stands at [s]
  double target;          // where a step is to end exactly [s]
  double end;             // of the run [s]
  double allowed;         // length of the next step, before it is fitted to the target [s]
  double tolerance;       // of a step's error
  double first_step;      // at the start, and the longest after a contact [s]
  double largest_step;    // [s]
  // Of the latest step accepted, in units of the tolerance; but not of one cut short with an error of at most a half.
  double error_before;
  double largest_motion;  // how long the diagonal of the box of touching vertices' ways in a step may be [m]
  double contact_step;    // in which it would be nearly as long, from the latest contact [s]
  double contact_until;   // the time up to which no step is longer than that: where one that met a contact was to end [s]
  double failed_step;     // with which the run ends [s]; 0: there is none
  double lowest_step;     // of the steps rejected in a row, for their errors: the one whose error was lowest [s]; 0: there is none
  double window_start;    // the time where the latest `pace_window` of steps began [s]
  double smallest_taken;  // of the steps that were accepted [s]
  double largest_taken;   // likewise [s]
  uint error;             // this step's, the largest over all vertices; bits of a float
  // The box of the ways that touching vertices went in this step, as ordered bits. No array: NVIDIA's driver 580 keeps a struct with
  // one in memory when functions pass it on, and its doubles as floats there.
  uint least_x, least_y, least_z, most_x, most_y, most_z;
  uint estimate_order;    // the error grows with this power of the step
  uint verdict;           // on the latest step
  uint accepted;          // steps, so far
  uint rejected;          // likewise
  uint rejected_in_contact;  // of them, not for their error but for the way that touching vertices went
  uint rejected_before;   // 1: the step before was, for its error
  uint lowest_error;      // in lowest_step; bits of a float
  uint failure;           // of failed_step
  uint is_too_slow;       // 1: at the pace of the window before, more steps are left than a run may have
};

// What a run may have: counts of forces have 32 bits.
FN double most_steps() { return double(3e8); }

// So many steps, rejected ones included, tell a pace that lasts from short steps on the way past a kink or through a contact.
const uint pace_window = 1000u;

// Shorter than this no step is tried again: its end would be lost in the time's rounding, or nothing helps.
FN double shortest_step(IN(Pace) pace) { return double(1e-14) * max(pace.time, pace.first_step); }

// A step of the allowed length, or one that ends at the target; what is left over is shared by two, so that no sliver remains.
FN double fitted_step(double allowed, double left) {
  if (!(left > double(0))) return double(0);
  if (left <= allowed) return left;
  return left < double(2) * allowed ? left * double(0.5) : allowed;
}

FN double next_step(IN(Pace) pace) { return fitted_step(pace.allowed, pace.target - pace.time); }

// Steps are meant to have this error, in units of the tolerance: so far below it that few are rejected. Measured at equal true error:
// against 0.4, with exponents 0.7 and 0.4, forces are summed 10 to 16 % less often where damping is kinked and no more often elsewhere.
FN double aimed_error() { return double(1) / double(10); }

// No step is longer than the one before by more than this factor.
FN double largest_growth() { return double(6); }

FN void forget_step(INOUT(Pace) pace) {
  pace.error = 0u;
  pace.least_x = pace.least_y = pace.least_z = 0xffffffffu;
  pace.most_x = pace.most_y = pace.most_z = 0u;
}

const uint infinite_error = 0x7f800000u;  // as bits; those of NaN are above

// A vertex's error from the method's two estimates e and f, all as bits of floats: e^2 / sqrt(e^2 + f^2 / 100), as in dop853. NaN
// counts as infinite; by bits, because shader compilers turn comparisons round as if there were no NaN.
FN uint joined_error(uint e_bits, uint f_bits) {
  if (max(e_bits, f_bits) >= infinite_error) return infinite_error;
  double e = double(uintBitsToFloat(e_bits)), f = double(uintBitsToFloat(f_bits));
  return e_bits == 0u ? 0u : floatBitsToUint(float(e * e / sqrt(e * e + f * f / double(100))));
}

// In units of the tolerance.
FN double judged_error(uint error_bits, double tolerance) {
  return error_bits >= infinite_error ? double(1e30) : double(uintBitsToFloat(error_bits)) / tolerance;
}

FN bool touches(IN(Pace) pace) { return pace.least_x <= pace.most_x; }

FN double extent(uint least, uint most) { return double(from_ordered_bits(most)) - double(from_ordered_bits(least)); }

// The diagonal of the box of the ways that touching vertices went, in units of what it may be: no two of them went further against
// each other. It grows with the step, and a common motion adds nothing; motion along surfaces and pairs far apart do.
FN double judged_motion(IN(Pace) pace) {
  if (!touches(pace)) return double(0);
  double x = extent(pace.least_x, pace.most_x), y = extent(pace.least_y, pace.most_y), z = extent(pace.least_z, pace.most_z);
  return sqrt(x * x + y * y + z * z) / pace.largest_motion;
}

// By what factor the next step may be longer than one with this error. GLSL has powers of floats alone.
FN double power_of_error(double error, float exponent) {
  double relative = max(error, double(1e-10)) / aimed_error();
  return double(pow(float(relative), exponent));
}

FN double after_acceptance(IN(Pace) pace, double error) {
  float k = float(pace.estimate_order);
  double factor = power_of_error(error, -0.5f / k) * power_of_error(pace.error_before, 0.2f / k);
  return clamp(factor, double(1) / double(3), largest_growth());
}

FN double after_rejection(IN(Pace) pace, double error) {
  return max(power_of_error(error, -1.0f / float(pace.estimate_order)), double(1) / double(3));
}

// After a step that was cut short for the target. Its small error is no reason for short steps, and says how long a free one may be;
// right after a rejection that is not tried.
FN double after_cut(IN(Pace) pace, double taken, double error) {
  double free_step = taken * min(power_of_error(error, -1.0f / float(pace.estimate_order)), largest_growth());
  return pace.rejected_before != 0u ? pace.allowed : max(free_step, pace.allowed);
}

// Three halvings have not lowered the error. One that is infinite tells nothing: it is never the lowest.
FN bool is_stalled(IN(Pace) pace, double taken, uint error_bits) {
  return error_bits >= pace.lowest_error && double(8) * taken <= pace.lowest_step;
}

// Whether a step with this error ends the run: if a vertex's does, so does the largest.
FN uint failure_of(IN(Pace) pace, double taken, uint error_bits) {
  double error = judged_error(error_bits, pace.tolerance);
  if (error > double(1) && (taken <= shortest_step(pace) || is_stalled(pace, taken, error_bits))) return no_length_meets;
  return pace.is_too_slow != 0u && error > aimed_error() / double(2) ? too_many_steps : no_failure;
}

FN void accept_step(INOUT(Pace) pace, double taken, double error) {
  double allowed = taken * after_acceptance(pace, error);
  if (pace.rejected_before != 0u) allowed = min(allowed, taken);
  if (taken < pace.allowed && error <= double(1) / double(2))  // with more the next one as long might be rejected
    allowed = after_cut(pace, taken, error);
  else
    pace.error_before = max(error, double(1) / double(10000));
  pace.allowed = min(allowed, pace.largest_step);
  pace.time = taken == pace.target - pace.time ? pace.target : pace.time + taken;
  pace.smallest_taken = pace.accepted == 0u ? taken : min(pace.smallest_taken, taken);
  pace.largest_taken = max(pace.largest_taken, taken);
  pace.accepted += 1u;
  pace.rejected_before = 0u;
  pace.lowest_step = double(0);
  pace.verdict = step_accepted;
}

FN void reject_step(INOUT(Pace) pace, double taken, double error) {
  pace.allowed = max(taken * after_rejection(pace, error), shortest_step(pace));
  if (pace.error < infinite_error && (pace.lowest_step == double(0) || pace.error < pace.lowest_error)) {
    pace.lowest_step = taken;
    pace.lowest_error = pace.error;
  }
  pace.rejected += 1u;
  pace.rejected_before = 1u;
  pace.verdict = step_rejected;
}

// Bodies would go too deep into each other to part again. Where they would have met, steps stay short.
FN void reject_contact(INOUT(Pace) pace, double taken) {
  pace.contact_until = max(pace.contact_until, pace.time + taken);
  pace.lowest_step = double(0);
  pace.rejected += 1u;
  pace.rejected_in_contact += 1u;
  pace.verdict = step_rejected;
}

// Errors from before a contact say nothing of a motion that it has broken off.
FN void follow_contact(INOUT(Pace) pace, double taken, double motion) {
  const double aimed_motion = double(4) / double(5);
  pace.contact_step = max(min(pace.first_step, taken * aimed_motion / max(motion, double(1e-6))), shortest_step(pace));
  pace.allowed = min(pace.allowed, pace.contact_step);
  pace.error_before = aimed_error();
}

// At the end of each window.
FN void watch_pace(INOUT(Pace) pace) {
  if ((pace.accepted + pace.rejected) % pace_window != 0u) return;
  bool is_too_slow = (pace.end - pace.time) * double(pace_window) > most_steps() * (pace.time - pace.window_start);
  pace.is_too_slow = is_too_slow ? 1u : 0u;
  pace.window_start = pace.time;
}

// Decides on a step of the length `taken`, and how long the next may be. One that ends the run stands, whatever its error. The
// shortest one stands, whatever its contacts.
FN void judge(INOUT(Pace) pace, double taken) {
  double error = judged_error(pace.error, pace.tolerance), motion = judged_motion(pace);
  uint failure = failure_of(pace, taken, pace.error);
  bool has_to_stand = failure != no_failure || taken <= shortest_step(pace);
  if (failure != no_failure) {
    pace.failure = failure;
    pace.failed_step = taken;
  }
  if (error > double(1) && !has_to_stand)
    reject_step(pace, taken, error);
  else if (motion > double(1) && !has_to_stand)
    reject_contact(pace, taken);
  else
    accept_step(pace, taken, error);
  if (touches(pace) && (pace.verdict == step_accepted || error <= double(1))) follow_contact(pace, taken, motion);
  if (pace.time < pace.contact_until) pace.allowed = min(pace.allowed, pace.contact_step);
  watch_pace(pace);
  forget_step(pace);
}

SHARED_END
#endif
