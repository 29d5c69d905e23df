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
SHARED_WRITE(impact_partner)
SHARED_WRITE(impact_sum)
SHARED_WRITE(impact_approach)
SHARED_WRITE(impact_part)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, part_count)
PARAMETER(double, least_speed)
PARAMETER(double, gravity_size)

const uint last_round = 4u;

bool goes_on_at(uint at) { return step_parts[0].parts - impact_part[at] < impact_ends_after; }
// One part more ends the impacts.
bool is_needed() {
  uint latest = impact_part[latest_of_all(body_count)];
  return latest != 0u && step_parts[0].parts - latest <= impact_ends_after;
}
uint items_in_a_round() { return is_needed() ? part_count : 0u; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

uint moments_half() { return from_half; }
#include "parts/rigid_motion_by_parts.glsl"
#include "parts/impact_pair.glsl"

// The mean velocity of a body's vertices in the world [m/s]. Static bodies and grounds have none.
dvec3 mean_velocity(uint b) {
  if (!is_movable(b)) return dvec3(0);
  return rotate(pose[b], LOAD3(part_sum[sums_of_body(b)].moments.velocity, 0u) / double(body[b].vertex_count));
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

void end_impact(uint at) {
  for (uint k = 0u; k < 3u; ++k) impact_sum[3u * at + k] = uvec2(0u);
  impact_partner[at] = impact_part[at] = 0u;
  impact_approach[at] = double(0);
}

// The note stands in the body's first part.
void note_parting(uint b) {
  if (is_movable(b)) ATOMIC_STORE(part_sum[sums_of_body(b)].parts_too_fast, 1u);
}

// The velocity is a's.
void judge_impact(uint a, uint b, uint at, dvec3 velocity) {
  double restitution = restitution_of_pair(restitution_of(a), restitution_of(b));
  dvec3 given = impact_unit(a, b) *
                dvec3(whole_of(impact_sum[3u * at]), whole_of(impact_sum[3u * at + 1u]), whole_of(impact_sum[3u * at + 2u]));
  double size = length(given);
  if (restitution < double(0) || size == double(0)) return;
  double parts_at = dot(given / size, velocity - mean_velocity(b));
  double approach = impact_approach[at];
  if (approach == double(0)) approach = size * (inverse_mass_of(a) + inverse_mass_of(b));
  approach = max(approach, -parts_at);
  impact_approach[at] = approach;
  if (approach == double(0) || parts_at <= max(restitution * approach, speed_of_rest(a, b))) return;
  note_parting(a);
  note_parting(b);
}

// A body that lacked a place begins anew: which of its impacts have got one depends on threads.
void judge_impacts(uint keeper) {
  uint lacks = lack_of_places_of(keeper, body_count);
  dvec3 velocity = mean_velocity(keeper);
  for (uint place = 0u; place < impact_places; ++place) {
    uint at = impact_at(keeper, place), partner = impact_partner[at];
    if (partner == 0u) continue;
    if (impact_part[lacks] != 0u || !goes_on_at(at))
      end_impact(at);
    else
      judge_impact(keeper, partner - 1u, at, velocity);
  }
  impact_part[lacks] = 0u;
}

void take_deformation(uvec4 part) {
  if (part_sum[sums_of_body(part.x)].parts_too_fast == 0u) return;
  RigidMotion rigid = rigid_motion_of_body(part.x);
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 velocity = velocity_at(rigid, place_of(i));
    STORE3(motion, velocity_of(vertex_at(i)), velocity)
  }
}

void restore_impacts(uint item, uint number) {
  uvec4 part = vertex_part[item];
  if (number == 0u) {
    sum_moments_of(part, item);
    part_sum[item].parts_too_fast = 0u;
  }
  if (number == 1u || number == 2u) add_up_moments(part, item, number == 2u);
  if (number == 3u && item == sums_of_body(part.x)) judge_impacts(part.x);
  if (number == last_round && status[part.x].activity == moving) take_deformation(part);
}
