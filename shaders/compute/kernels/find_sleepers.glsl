// A kernel in rounds, behind all that moves bodies in a step. One thread serves one body. A body wakes if it was disturbed. It counts how
// long it has been fit to sleep, in steps that stand: slow, pushed by something, and not stirred. An island falls asleep when all of its
// bodies have long been so, and what does not move bears one of them. follow_bodies and change_frame then take their motion.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/debt.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
WRITE(status)
READ(step_parts)
READ(pressed)
READ(debt)
SHARED_WRITE(contact_list)
SHARED_WRITE(cluster)
PARAMETER(uint, body_count)

const uint last_round = 1u;
uint items_in_a_round() { return body_count; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

// It is neither empty nor undone.
bool step_stands() { return control[0].time_step > double(0); }

// Whether a part of a step with this number was one of the latest.
bool is_recent(uint part) { return part != 0u && step_parts[0].parts - part < held_for; }

bool is_fit_to_sleep(uint b) { return cluster[b].is_stirred == 0u && is_recent(pressed[b]) && debt[b].energy == double(0); }

void count_slow_time(uint b) {
  status[b].slow_for = is_fit_to_sleep(b) ? min(status[b].slow_for + float(control[0].time_step), sleeps_after) : 0.0f;
}

// What sleeps, or is at rest without that, keeps nobody awake.
void tell_island(uint b) {
  uint first = cluster[b].island;
  if (status[b].slow_for < sleeps_after && status[b].calm < quiet) ATOMIC_STORE(cluster[first].is_restless, 1u);
  if (is_recent(status[b].pressed_by_static)) ATOMIC_STORE(cluster[first].is_borne, 1u);
}

void fall_asleep(uint b) {
  uint first = cluster[b].island;
  if (status[b].slow_for < sleeps_after || cluster[first].is_restless != 0u || cluster[first].is_borne == 0u) return;
  status[b].falls_asleep = 1u;
  status[b].slow_for = 0.0f;  // once awake it has to be slow anew
}

// In a step that was undone, too: bodies of its island may have been pushed there.
void wake_if_disturbed(uint b) {
  if (status[b].asleep != 0u && status[b].disturbed != 0u) status[b].asleep = status[b].calm = 0u;
}

void find_sleepers(uint b, uint number) {
  if (number == 0u) status[b].falls_asleep = 0u;
  if (number == 0u) wake_if_disturbed(b);
  if (!step_stands() || status[b].activity != moving || status[b].asleep != 0u) return;
  if (number == 0u) count_slow_time(b);
  if (number == 0u) tell_island(b);
  if (number == 1u) fall_asleep(b);
}
