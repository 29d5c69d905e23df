// A kernel in rounds, at a step's start. One thread serves some vertices of a body. Bodies that touch and part faster than their
// restitution allows lose their deformation velocities. So they have nothing that would drive them further apart. Both momenta stay.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/impact.glsl"
#include "../physics/contact/part_sums.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(body)
READ(pose)
READ(status)
READ(surface)
READ(step_parts)
READ(control)
READ(rest_position)
WRITE(motion)
READ(vertex_part)
READ(vertex_part_range)
SHARED_WRITE(contact_list)
SHARED_WRITE(part_sum)
SHARED_WRITE(impact_sum)
SHARED_WRITE(impact)
SHARED_WRITE(impact_part)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, part_count)
PARAMETER(double, least_speed)
PARAMETER(double, gravity_size)

const uint last_round = 2u;

bool goes_on_at(uint at) { return impact_part[at] != 0u && step_parts[0].parts - impact_part[at] < impact_ends_after; }
// The last entry has the latest part of all. One part more ends the impacts.
bool is_needed() {
  uint latest = impact_part[impact_count(body_count)];
  return latest != 0u && step_parts[0].parts - latest <= impact_ends_after;
}
uint items_in_a_round() { return is_needed() ? part_count : 0u; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

uint moments_half() { return from_half; }
#include "parts/rigid_motion_by_parts.glsl"
#include "parts/impact_unit.glsl"

bool is_movable(uint b) { return inverse_vertex_mass(b) > double(0); }

// The mean velocity of a body's vertices in the world [m/s]. Static bodies and grounds have none.
dvec3 mean_velocity(uint b) {
  if (!is_movable(b)) return dvec3(0);
  uvec2 range = vertex_part_range[b];
  dvec3 sum = dvec3(0);
  for (uint k = range.x; k < range.x + range.y; ++k) sum += LOAD3(part_sum[k].moments.velocity, 0u);
  return rotate(pose[b], sum / double(body[b].vertex_count));
}
double inverse_mass_of(uint b) { return is_movable(b) ? inverse_vertex_mass(b) / double(body[b].vertex_count) : double(0); }
double restitution_of(uint b) { return b < body_count ? surface[b].restitution : double(-1); }

// Bodies that rest on each other swing by what gravity gives them in a step. With a fixed length that is the scene's step. With a tolerance
// it is this step, or the last one if that was longer. The bound of contact limits both. If bodies lost that swing, they would be pressed
// ever closer.
double speed_of_rest(uint a, uint b) {
  double longest = step_parts[0].divides != 0u ? step_parts[0].full : max(control[0].time_step, step_parts[0].last);
  if (is_movable(a)) longest = min(longest, surface[a].longest_pressed);
  if (is_movable(b)) longest = min(longest, surface[b].longest_pressed);
  return double(2) * gravity_size * longest;
}

void judge_impact(uint a, uint b) {
  uint at = impact_of(a, b, body_count);
  if (!goes_on_at(at)) {
    if (impact_part[at] == 0u) return;
    for (uint k = 0u; k < 3u; ++k) impact_sum[3u * at + k] = uvec2(0u);
    impact_part[at] = 0u;
    impact[at].approach = double(0);
    impact[at].parts_too_fast = 0u;
    return;
  }
  double restitution = restitution_of_pair(restitution_of(a), restitution_of(b));
  dvec3 given = impact_unit(a, b) *
                dvec3(whole_of(impact_sum[3u * at]), whole_of(impact_sum[3u * at + 1u]), whole_of(impact_sum[3u * at + 2u]));
  double size = length(given);
  if (restitution < double(0) || size == double(0)) return;
  double parts_at = dot(given / size, mean_velocity(a) - mean_velocity(b));
  if (impact[at].approach == double(0)) impact[at].approach = size * (inverse_mass_of(a) + inverse_mass_of(b));
  impact[at].approach = max(impact[at].approach, -parts_at);
  impact[at].parts_too_fast = parts_at > max(restitution * impact[at].approach, speed_of_rest(a, b)) ? 1u : 0u;
}

void judge_impacts(uint a) {
  for (uint b = 0u; b <= body_count; ++b) {
    if (b == a || (is_movable(b) && b < a)) continue;
    judge_impact(min(a, b), max(a, b));
  }
}

bool parts_too_fast(uint a) {
  bool does = false;
  for (uint b = 0u; b <= body_count; ++b) {
    uint at = impact_of(min(a, b), max(a, b), body_count);
    if (b != a && goes_on_at(at) && impact[at].approach > double(0)) does = does || impact[at].parts_too_fast != 0u;
  }
  return does;
}

void take_deformation(uvec4 part) {
  if (!parts_too_fast(part.x)) return;
  RigidMotion rigid = rigid_motion_of_body(part.x);
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 velocity = velocity_at(rigid, place_of(i));
    STORE3(motion, velocity_of(vertex_at(i)), velocity)
  }
}

void restore_impacts(uint item, uint number) {
  uvec4 part = vertex_part[item];
  if (number == 0u) sum_moments_of(part, item);
  if (number == 1u && item == vertex_part_range[part.x].x) judge_impacts(part.x);
  if (number == 2u && status[part.x].activity == moving) take_deformation(part);
}
