// How long steps are if a tolerance governs them. The controller is proportional-integral. Sources:
// - Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554
// - Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4 and II.5 (dop853's estimate)
#ifndef PACE_GLSL
#define PACE_GLSL
#include "collision/box.glsl"
SHARED_BEGIN
#ifdef __cplusplus
using std::pow, glm::clamp;
#endif

// Values of Pace.verdict: what became of a step.
const uint step_accepted = 0u;
const uint step_rejected = 1u;  // it is undone, because its error was too large or its contacts were too deep
const uint step_empty = 2u;     // no step was made, because the target was reached
const uint run_over = 3u;       // no step is made any more

// Values of Pace.failure: why a step ends the run.
const uint no_failure = 0u;
const uint no_length_meets = 1u;  // its error is too large, and shorter steps do not help
const uint too_many_steps = 2u;   // at the length that errors demand, the run would have more steps than it may

struct Pace {
  double time;            // of the state [s]
  double target;          // a step has to end exactly here [s]
  double end;             // of the run [s]
  double allowed;         // length of the next step, before it is fitted to the target [s]
  double tolerance;       // of a step's error
  double first_step;      // length of the first step, and the longest one after a contact [s]
  double largest_step;    // [s]
  // Error of the latest accepted step, in units of the tolerance. Steps that were cut short do not count if it is at most a half.
  double error_before;
  double largest_motion;  // how long the diagonal of the box of touching vertices' ways in a step may be [m]
  double contact_step;    // in a step of this length touching vertices go nearly largest_motion, by the latest contact [s]
  double contact_until;   // before this time no step is longer than contact_step: a step with too deep contacts was to end then [s]
  double failed_step;     // length of the step that ends the run [s], 0 if there is none
  double lowest_step;     // length of the step whose error was lowest, of those rejected in a row for their errors [s], or 0
  double window_start;    // time at which the latest `pace_window` of steps began [s]
  double smallest_taken;  // length of the shortest accepted step [s]
  double largest_taken;   // length of the longest accepted step [s]
  uint error;             // this step's, the largest over all vertices, as bits of a float
  // The box of the ways that touching vertices went in this step, as ordered bits. It is no array: NVIDIA's driver 580 keeps structs
  // with arrays in memory when functions pass them on, and stores their doubles as floats there.
  uint least_x, least_y, least_z, most_x, most_y, most_z;
  uint estimate_order;    // the error grows with this power of the step
  uint verdict;           // on the latest step
  uint accepted;          // number of accepted steps
  uint rejected;          // number of rejected steps
  uint rejected_in_contact;  // those of them that were rejected for the way that touching vertices went, not for their error
  uint rejected_before;   // 1: a step was rejected for its error after the latest accepted one
  uint lowest_error;      // error of lowest_step, as bits of a float
  uint failure;           // why failed_step ends the run
  uint is_too_slow;       // 1: at the pace of the window before, more steps are left than a run may have
};

// A run may have this many steps, because counts of forces have 32 bits.
FN double most_steps() { return double(3e8); }

// Steps of a window, with the rejected ones. So many tell a pace that lasts from short steps past a kink or through a contact.
const uint pace_window = 1000u;

// No step shorter than this [s] is tried again. Its end would be lost in the time's rounding, or no shorter step helps.
FN double shortest_step(IN(Pace) pace) { return double(1e-14) * max(pace.time, pace.first_step); }

// Returns the length of the next step [s]: the allowed one, or what is left up to the target. If less than two allowed steps are left,
// two equal steps share that, so that no sliver remains. Returns 0 at the target.
FN double fitted_step(double allowed, double left) {
  if (!(left > double(0))) return double(0);
  if (left <= allowed) return left;
  return left < double(2) * allowed ? left * double(0.5) : allowed;
}

FN double next_step(IN(Pace) pace) { return fitted_step(pace.allowed, pace.target - pace.time); }

// Steps aim at this error, in units of the tolerance. It is so far below 1 that few steps are rejected. It was measured at equal true
// error against 0.4 with exponents 0.7 and 0.4. Forces are summed 10 to 16 % less often if damping is kinked, and no more often elsewhere.
FN double aimed_error() { return double(1) / double(10); }

// No step is longer than the one before by more than this factor.
FN double largest_growth() { return double(6); }

FN void forget_step(INOUT(Pace) pace) {
  pace.error = 0u;
  pace.least_x = pace.least_y = pace.least_z = 0xffffffffu;
  pace.most_x = pace.most_y = pace.most_z = 0u;
}

const uint infinite_error = 0x7f800000u;  // bits of infinity, those of NaN are above

// Returns a vertex's error from the method's two estimates e and f: e^2 / sqrt(e^2 + f^2 / 100), as in dop853. All three are bits of
// floats. NaN counts as infinite. Bits are compared, because shader compilers turn comparisons of floats round as if there were no NaN.
FN uint joined_error(uint e_bits, uint f_bits) {
  if (max(e_bits, f_bits) >= infinite_error) return infinite_error;
  double e = double(uintBitsToFloat(e_bits)), f = double(uintBitsToFloat(f_bits));
  return e_bits == 0u ? 0u : floatBitsToUint(float(e * e / sqrt(e * e + f * f / double(100))));
}

// Returns an error, given as bits of a float, in units of the tolerance.
FN double judged_error(uint error_bits, double tolerance) {
  return error_bits >= infinite_error ? double(1e30) : double(uintBitsToFloat(error_bits)) / tolerance;
}

FN bool touches(IN(Pace) pace) { return pace.least_x <= pace.most_x; }

FN double extent(uint least, uint most) { return double(from_ordered_bits(most)) - double(from_ordered_bits(least)); }

// Returns the diagonal of the box of the ways that touching vertices went, in units of what it may be. No two of these vertices went
// further against each other. The diagonal grows with the step. A common motion adds nothing. Motion along surfaces and pairs far
// apart add to it.
FN double judged_motion(IN(Pace) pace) {
  if (!touches(pace)) return double(0);
  double x = extent(pace.least_x, pace.most_x), y = extent(pace.least_y, pace.most_y), z = extent(pace.least_z, pace.most_z);
  return sqrt(x * x + y * y + z * z) / pace.largest_motion;
}

// Returns the factor by which the next step may be longer than one with this error. GLSL has powers of floats alone.
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

// Returns how long the next step may be after one of the length `taken` that was cut short for the target [s]. The small error of such
// a step is no reason for short steps: it says how long a free step may be. Right after a rejection no longer step is tried.
FN double after_cut(IN(Pace) pace, double taken, double error) {
  double free_step = taken * min(power_of_error(error, -1.0f / float(pace.estimate_order)), largest_growth());
  return pace.rejected_before != 0u ? pace.allowed : max(free_step, pace.allowed);
}

// Whether three halvings have not lowered the error. An infinite error tells nothing: it is never the lowest.
FN bool is_stalled(IN(Pace) pace, double taken, uint error_bits) {
  return error_bits >= pace.lowest_error && double(8) * taken <= pace.lowest_step;
}

// Whether and why a step of the length `taken` [s] with this error ends the run. If one vertex's error does, so does the largest.
FN uint failure_of(IN(Pace) pace, double taken, uint error_bits) {
  double error = judged_error(error_bits, pace.tolerance);
  if (error > double(1) && (taken <= shortest_step(pace) || is_stalled(pace, taken, error_bits))) return no_length_meets;
  return pace.is_too_slow != 0u && error > aimed_error() / double(2) ? too_many_steps : no_failure;
}

FN void accept_step(INOUT(Pace) pace, double taken, double error) {
  double allowed = taken * after_acceptance(pace, error);
  if (pace.rejected_before != 0u) allowed = min(allowed, taken);
  if (taken < pace.allowed && error <= double(1) / double(2))  // with a larger error the next step of that length might be rejected
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

// Undoes a step in which bodies went too deep into each other to part again. Steps stay short up to where it was to end.
FN void reject_contact(INOUT(Pace) pace, double taken) {
  pace.contact_until = max(pace.contact_until, pace.time + taken);
  pace.lowest_step = double(0);
  pace.rejected += 1u;
  pace.rejected_in_contact += 1u;
  pace.verdict = step_rejected;
}

// Shortens steps after a contact. Errors from before it say nothing of a motion that it has broken off.
FN void follow_contact(INOUT(Pace) pace, double taken, double motion) {
  const double aimed_motion = double(4) / double(5);
  pace.contact_step = max(min(pace.first_step, taken * aimed_motion / max(motion, double(1e-6))), shortest_step(pace));
  pace.allowed = min(pace.allowed, pace.contact_step);
  pace.error_before = aimed_error();
}

// Compares the pace with what a run may have, at the end of each window.
FN void watch_pace(INOUT(Pace) pace) {
  if ((pace.accepted + pace.rejected) % pace_window != 0u) return;
  bool is_too_slow = (pace.end - pace.time) * double(pace_window) > most_steps() * (pace.time - pace.window_start);
  pace.is_too_slow = is_too_slow ? 1u : 0u;
  pace.window_start = pace.time;
}

// Decides on a step of the length `taken` [s], and how long the next may be. A step that ends the run stands, whatever its error. The
// shortest step stands, whatever its contacts.
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
