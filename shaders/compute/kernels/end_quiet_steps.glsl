// One thread serves one body after quiet steps. It counts what they did, and empties what the next step adds to.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/quiet.glsl"
READ(quiet_steps)
READ(quiet_body)
READ(body)
READ(pose)
WRITE(control)
WRITE(status)
WRITE(tally)
WRITE(slept)
WRITE(body_box)
WRITE(meeting)
PARAMETER(uint, pair_count)  // of bodies that might touch
PARAMETER(uint, forces_of_a_step)
#include "parts/add_to_total.glsl"
#include "parts/note_step_asleep.glsl"

void move_clock(uint made) {
  control[0].step += made;
  add_to_total(quiet_steps_made, made);
  for (uint k = 0u; k < made; ++k) add_to_total(body_pairs_skipped, pair_count);
  if (quiet_steps[0].begun != 0u && (quiet_steps[0].arrivals & waited_in_vain) != 0u) status[0].activity = halted_waiting;
}

void count_work(uint b, uint made) {
  Status s = status[b];
  if (s.calm >= at_rest && s.asleep == 0u) tally[b].steps_at_rest += made;
  for (uint k = 0u; k < made && is_asleep(s) && s.activity == moving; ++k) note_step_asleep(b);
  tally[b].frame_changes += quiet_body[b].frame_changes;
  if (s.activity != moving) return;
  if (s.asleep == 0u) status[b].slow_for = 0.0f;  // nothing has pushed it
  if (is_still(s) || s.deformed == 0u)
    tally[b].forces_skipped += made * forces_of_a_step;
  else
    tally[b].force_evaluations += made * forces_of_a_step;
}

void end_quiet_steps(uint b) {
  uint made = steps_made(quiet_steps[0]);
  if (b == 0u) move_clock(made);
  if (made > 0u) count_work(b, made);
  for (uint k = 0u; k < 3u && status[b].calm != at_rest; ++k) {
    body_box[b].lower[k] = 0xffffffffu;
    body_box[b].upper[k] = 0u;
  }
  meeting[b] = 0u;
}
