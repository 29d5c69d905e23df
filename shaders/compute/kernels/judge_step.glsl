// One thread in all decides whether the step stands, when its error and its contacts are known. If it stands, the time moves on.
// Otherwise its contacts do not count.
#include "../physics/control.glsl"
#include "../physics/pace.glsl"
WRITE(pace)
WRITE(control)

void judge_step(uint item) {
  Pace p = pace[item];
  if (control[0].non_finite_step != 0u)
    p.verdict = run_over;
  else if (control[0].time_step == double(0))
    p.verdict = step_empty;
  else
    judge(p, control[0].time_step);
  if (p.verdict == step_rejected) {
    control[0].count[contact_pairs] = 0u;
    control[0].count[unsettled_contacts] = 0u;
    control[0].time_step = double(0);
  }
  pace[item] = p;
}
