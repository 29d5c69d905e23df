// A kernel in rounds, behind all that moves bodies in a step. One thread serves one body. A body wakes if it was disturbed. It counts how
// long it has been fit to sleep, in steps that stand: near where it was, pushed by something, and not stirred. An island falls asleep when
// all of its bodies have long been so, and what does not move bears one of them. follow_bodies and change_frame then take their motion.
// Contacts make vertices tremble, at ten times the speed at which the body moves. So a body is slow that stays where it is, as in Jolt
// Physics, and trembles with little energy.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/debt.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(body)
READ(motion)
READ(world_position)
WRITE(slow_place)
WRITE(status)
READ(step_parts)
READ(pressed)
READ(debt)
SHARED_WRITE(contact_list)
SHARED_WRITE(cluster)
PARAMETER(uint, body_count)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(double, sleep_speed)  // [m/s]
PARAMETER(double, sleep_way)    // a body may sleep that stays within this of where it was [m]

const uint last_round = 1u;
uint items_in_a_round() { return body_count; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

// It is neither empty nor undone.
bool step_stands() { return control[0].time_step > double(0); }

// Whether a part of a step with this number was one of the latest.
bool is_recent(uint part) { return part != 0u && step_parts[0].parts - part < held_for; }

bool is_fit_to_sleep(uint b) { return cluster[b].is_stirred == 0u && is_recent(pressed[b]) && debt[b].energy == double(0); }

// Of the k-th vertex that stands for the body.
uint sample_in_half(uint b, uint k, uint half_index) {
  return in_half(half_index, vertex_count, sample_vertex(body[b].first_vertex, body[b].vertex_count, k));
}

// A window of slow time begins where the step did.
void begin_window(uint b) {
  for (uint k = 0u; k < sample_count; ++k) slow_place[sample_count * b + k] = world_position[sample_in_half(b, k, from_half)];
}

bool has_stayed(uint b) {
  float farthest = 0.0f;
  for (uint k = 0u; k < sample_count; ++k) {
    vec4 gone = world_position[sample_in_half(b, k, other_half(from_half))] - slow_place[sample_count * b + k];
    farthest = max(farthest, dot(gone, gone));
  }
  return double(farthest) <= sleep_way * sleep_way;
}

// Whether the mean of the squares of its speeds is small.
bool trembles_little(uint b) {
  double squares = double(0), most = tremble_ratio * sleep_speed * control[0].time_step;
  for (uint k = 0u; k < sample_count; ++k) {
    uint after = displacement_of(sample_in_half(b, k, other_half(from_half)));
    dvec3 gone = LOAD3(motion, after) - LOAD3(motion, displacement_of(sample_in_half(b, k, from_half)));
    squares += dot(gone, gone);
  }
  return squares <= double(sample_count) * most * most;
}

// A body that creeps on stays fit to sleep until others of its island are, too. So windows of sleeps_after follow each other. The first
// begins at 0, all others begin at sleeps_after, and each ends at window_end.
const float window_end = float(2) * sleeps_after;

void count_slow_time(uint b) {
  float before = status[b].slow_for;
  if (before == 0.0f || before == window_end) begin_window(b);
  if (before == window_end) before = sleeps_after;
  float slow_for = before + float(control[0].time_step), end = before < sleeps_after ? sleeps_after : window_end;
  if (slow_for >= end) slow_for = window_end;
  status[b].slow_for = is_fit_to_sleep(b) && trembles_little(b) && has_stayed(b) ? slow_for : 0.0f;
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
