// Several threads compare one body with all that move. They find for how many steps these surely stay apart, and the first one the same of
// the body and grounds. If something acts that lasts from earlier contacts, no step is quiet.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/debt.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/quiet.glsl"
READ(control)
READ(share)
READ(surface)
READ(ground)
READ_AS(place_box, BoxBits, body_box)
READ(body_motion)
READ(step_parts)
READ(status)
READ(pressed)
READ(contact_list)
READ(debt)
READ(cluster)
WRITE(quiet_steps)
READ(quiet_body)
PARAMETER(uint, body_count)
PARAMETER(uint, threads_of_a_body)
PARAMETER(uint, ground_count)
#include "parts/quiet_region.glsl"
#include "parts/dues.glsl"
#include "parts/height_above.glsl"
#include "parts/is_steady.glsl"

void allow(uint steps) { atomicMin(quiet_steps[0].end, steps); }

// Whether the run has whole steps behind it, without contacts and cuts in the latest one.
bool begins_quietly() {
  StepParts p = step_parts[0];
  ContactList list = contact_list[0];
  return control[0].non_finite_vertex == no_vertex && p.divides != 0u && p.left == smallest_parts && p.last == p.full &&
         p.longest == no_bound && list.latest_count == 0u && list.arrivals == 0u && !has_dues();
}

bool is_bound_by_pressing(uint b) {
  return pressed[b] != 0u && step_parts[0].parts + 1u - pressed[b] <= pressed_for &&
         surface[b].longest_pressed < step_parts[0].full;
}

bool moves(uint b) { return status[b].activity != immovable && !is_idle(status[b]); }

bool may_be_quiet(uint b) {
  bool was_pressed = pressed[b] != 0u && step_parts[0].parts - pressed[b] < held_for;
  return is_steady(status[b]) && (!moves(b) || (!was_pressed && !is_bound_by_pressing(b)));
}

bool is_above(uint g, uint b, uint steps) {
  Box box = quiet_region(b, steps);
  return height_above(g, dvec3(box.lower), dvec3(box.upper)) > double(2) * gap_above(ground[g], surface[b]) + surface[b].nearness;
}

void look_at(uint b) {
  if (b == 0u && !begins_quietly()) allow(0u);
  if (!may_be_quiet(b)) allow(0u);
  if (!moves(b)) return;
  if (status[b].steps_to_star != 0u && status[b].deformed != 0u) allow(0u);
  uint steps = most_quiet_steps;
  for (uint g = 0u; g < ground_count; ++g)
    while (steps >= fewest_quiet_steps && !is_above(g, b, steps)) steps /= 2u;
  allow(steps >= fewest_quiet_steps ? steps : 0u);
}

void compare(uint a, uint b) {
  uint steps = most_quiet_steps;
  while (steps >= fewest_quiet_steps && overlaps(quiet_region(a, steps), quiet_region(b, steps))) steps /= 2u;
  allow(steps >= fewest_quiet_steps ? steps : 0u);
}

void limit_quiet_steps(uint item) {
  uint b = item / threads_of_a_body, thread = item % threads_of_a_body;
  if (ATOMIC_LOAD(quiet_steps[0].end) == 0u) return;
  if (thread == 0u) look_at(b);
  for (uint n = thread; n < quiet_steps[0].moving_shares; n += threads_of_a_body) {
    uint k = quiet_body[n].moving_share, other = share[k].body_index;
    if (share[k].first_vertex != share[k].body.first_vertex) continue;  // each body is compared once, by its first share
    // two that both move are both listed, and the later one compares them
    if (other < b || (other > b && !moves(b))) compare(other, b);
  }
}
