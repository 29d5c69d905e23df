// One thread, when a step's error and its contacts are known: does it stand? If so the time moves on, else its contacts do not count.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/pace.glsl"
WRITE(pace)
WRITE(control)
READ(frame)

void judge_step(uint item) {
  Pace p = pace[item];
  if (frame[0].halted != not_halted)
    p.verdict = frame[0].halted == halted_for_now ? step_empty : run_over;
  else
    judge(p, frame[0].time_step);
  if (p.verdict == step_rejected) control[0].count[contact_pairs] = 0u;
  pace[item] = p;
}
