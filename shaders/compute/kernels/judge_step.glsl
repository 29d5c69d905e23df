// One thread: does the step stand? If so the time moves on.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/pace.glsl"
WRITE(0, Paces, Pace, pace)
READ(1, Controls, Control, control)
READ(2, Frames, Frame, frame)

void judge_step(uint item) {
  Pace p = pace[item];
  if (frame[0].halted != not_halted) {
    p.verdict = frame[0].halted == halted_for_good ? run_over : step_empty;
  } else {
    if (control[0].contact_steps != p.contact_steps) start_anew(p, control[0].contact_steps);
    judge(p, frame[0].time_step);
  }
  pace[item] = p;
}
