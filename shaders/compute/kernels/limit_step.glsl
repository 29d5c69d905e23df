// Compares bodies that may reach each other, and bounds the length of the step. No two of their vertices may approach by more than the
// distance of the bodies and a quarter edge, and a body that meets itself may not approach a ground by more. Bodies that could touch within
// two steps, and those that were pressed a while ago, have a bound of their own. It also finds how much further than expected bodies may
// move without meeting others that are far, how bodies that meet may push each other, which bodies are one island, and which of them
// another one disturbs.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/grid.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(body)
READ(surface)
READ(start)
READ_AS(place_box, BoxBits, body_box)
WRITE(status)
READ(body_motion)
READ(pressed)
WRITE(step_parts)
WRITE(room)
WRITE(cluster)
READ(grid_list)
READ(grid_entry)
READ(grid_level)
READ(ground)
PARAMETER(uint, body_count)
PARAMETER(uint, ground_count)
#include "parts/bound_step.glsl"
#include "parts/height_above.glsl"
#include "parts/reach.glsl"

// The largest that a number of the first box can be above one of the second.
double above(uint upper, uint lower) { return double(from_ordered_bits(upper)) - double(from_ordered_bits(lower)); }

dvec3 all_above(IN(BoxBits) a, IN(BoxBits) b) {
  return dvec3(above(a.upper[0], b.lower[0]), above(a.upper[1], b.lower[1]), above(a.upper[2], b.lower[2]));
}

// How fast vertices of the two can move against each other, at most [m/s].
double approach(uint a, uint b) {
  return length(max(max(all_above(body_motion[a], body_motion[b]), all_above(body_motion[b], body_motion[a])), dvec3(0)));
}

// The way from one body's box to the other's, along each axis, or 0 where they overlap.
dvec3 way_between(uint a, uint b) {
  return max(max(-all_above(body_box[a], body_box[b]), -all_above(body_box[b], body_box[a])), dvec3(0));
}

// How far the body is expected to go up or down along each axis in so long a time [m].
dvec3 way_up(uint b, double time) { return time * max(dvec3(box_of_bits(body_motion[b]).upper), dvec3(0)); }
dvec3 way_down(uint b, double time) { return time * max(-dvec3(box_of_bits(body_motion[b]).lower), dvec3(0)); }

// Shares what is left of two bodies' distance on some axis once each has gone its own way, so that boxes which grow by it on all sides
// stay apart there. Rounding takes less than what is held back.
void keep_apart(uint a, uint b, double time) {
  dvec3 above_a = -all_above(body_box[a], body_box[b]) - way_up(a, time) - way_down(b, time);
  dvec3 above_b = -all_above(body_box[b], body_box[a]) - way_up(b, time) - way_down(a, time);
  dvec3 left = max(above_a, above_b);
  uint share_of_it = floatBitsToUint(max(float(max(max(left.x, left.y), left.z)) * 0.45f, 0.0f));
  LOWER_TO(room[a].to_others, share_of_it)
  LOWER_TO(room[b].to_others, share_of_it)
}

// The most that a vertex of the first body gets of a speed: it meets a triangle, which weighs as three of the other's vertices.
double share_of(uint a, uint b) { return surface[a].inverse_mass / (surface[a].inverse_mass + surface[b].inverse_mass / double(3)); }

// Bounds what the second body may do to velocities of the first. A contact takes a part of the relative velocity w along its normal, and
// friction at most all of the rest. All that this can give lies in the ball that has no change and w at opposite ends.
void push_away(uint a, uint b, double speed) {
  double part = (double(1) + mean_of_pair(surface[a].elasticity, surface[b].elasticity)) * share_of(a, b);
  for (uint k = 0u; k < 3u; ++k) {
    double least_along = -above(body_motion[a].upper[k], body_motion[b].lower[k]);
    double most_along = above(body_motion[b].upper[k], body_motion[a].lower[k]);
    uint least = ordered_bits(float(double(0.5) * part * (least_along - speed)));
    uint most = ordered_bits(float(double(0.5) * part * (most_along + speed)));
    atomicMin(room[a].least_push[k], least);  // nobody waits for their results
    atomicMax(room[a].most_push[k], most);
  }
}

bool moves(uint b) { return surface[b].inverse_mass != double(0); }  // by forces and impulses

// If the first body moves, it disturbs the other one, which it may reach. One that sleeps is not disturbed if it surely does not. From
// beyond its island it stirs the other one, as scripted bodies always do.
void disturb(uint a, uint b, bool is_beside, bool reaches) {
  if (status[a].activity == immovable || status[a].calm >= quiet || !moves(b)) return;
  if (reaches || status[b].asleep == 0u) ATOMIC_STORE(status[b].disturbed, 1u);
  if (reaches && (!is_beside || !moves(a))) ATOMIC_STORE(cluster[b].is_stirred, 1u);
}

// The mean velocity of the vertices that stand for the body [m/s].
dvec3 mean_velocity(uint b) {
  dvec3 sum = dvec3(0);
  for (uint k = 0u; k < sample_count; ++k) {
    uint i = sample_vertex(body[b].first_vertex, body[b].vertex_count, k);
    sum += LOAD3(start, start_velocity_of(i));
  }
  return sum / double(sample_count);
}

// Makes two bodies one island, without locks: each body names itself or an earlier one. If it named another before, that one joins, too.
void join(uint a, uint b) {
  if (a == b) return;
  ATOMIC_STORE(cluster[a].has_company, 1u);
  ATOMIC_STORE(cluster[b].has_company, 1u);
  ATOMIC_STORE(cluster[body_count].has_company, 1u);
  while (a != b) {
    uint earlier = min(a, b), later = max(a, b), before = atomicMin(cluster[later].island, earlier);
    if (before == later) return;
    a = earlier;
    b = before;
  }
}

Box box_to_meet(uint b) { return reach_box_of(b); }

void meet(uint a, uint b) {
  if (!moves(a) && !moves(b)) return;
  dvec3 between = way_between(a, b);
  double longest = step_parts[0].full, speed = approach(a, b), distance = length(between);
  bool is_beside = distance <= max(edge_of_pair(surface[a], surface[b]), surface[a].nearness + surface[b].nearness);
  if (moves(a) && moves(b) && is_beside) join(a, b);
  if (status[a].calm >= quiet && status[b].calm >= quiet) return;  // neither moves, and what they have of room does not depend on others
  bool reaches = is_beside || double(2) * speed * longest > distance;
  disturb(a, b, is_beside, reaches);
  disturb(b, a, is_beside, reaches);
  double most = distance + double(0.25) * edge_of_pair(surface[a], surface[b]);
  if (speed * longest > most) longest = most / speed;
  if (speed * longest > distance) {
    push_away(a, b, speed);
    push_away(b, a, speed);
  }
  if (double(2) * speed * longest > distance) longest = min(longest, min(surface[a].longest_pressed, surface[b].longest_pressed));
  keep_apart(a, b, longest);
  bound_step(longest);
}

#include "parts/each_pair.glsl"
#include "parts/is_in_cluster.glsl"

// A body begins as an island of its own, together with its cluster. One that breaks apart does not fly. That compares bits, because
// compilers turn comparisons of floats round as if there were no NaN.
void begin_flight(uint b) {
  dvec3 velocity = mean_velocity(b);
  STORE3(cluster[b].island_velocity, 0u, velocity)
  if (floatBitsToUint(float(sum_of_sizes(velocity))) > floatBitsToUint(1e30f)) ATOMIC_STORE(cluster[b].cannot_fly, 1u);
  if (is_in_cluster(b)) join(b, cluster[b].first);
}

// Bodies whose reaches are apart keep so far from each other. One body alone has all the room.
void bound_room(uint b) {
  if (body_count == 1u) return;
  LOWER_TO(room[b].to_others, floatBitsToUint(float(play_of(b, box_of_body(b))) * 0.9f))
}

// A body that was pressed a while ago has a bound of its own.
void bound_pressed(uint b) {
  if (pressed[b] != 0u && step_parts[0].parts + 1u - pressed[b] <= pressed_for) bound_step(surface[b].longest_pressed);
}

// A ground must not dent a body that meets itself by more than a quarter edge at once.
void bound_dents(uint b) {
  Box places = box_of_bits(body_box[b]), velocities = box_of_bits(body_motion[b]);
  for (uint g = 0u; g < ground_count && surface[b].meets_itself != 0u; ++g) {
    double height = height_above(g, dvec3(places.lower), dvec3(places.upper));
    double falls = -least_along(LOAD3(ground[g].normal, 0u), dvec3(velocities.lower), dvec3(velocities.upper));
    bound_speed(falls, max(height, double(0)) + double(0.25) * surface[b].edge);
  }
}

void limit_step(uint item) {
  uint b = body_of(item);
  if (b != no_body && moves(b)) {
    begin_flight(b);
    bound_pressed(b);
    bound_dents(b);
    bound_room(b);
  }
  visit_pairs(item);
}
