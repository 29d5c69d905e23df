// Runs quiet steps. All groups make a step, each for its shares, and meet. Then they know whether it stands, and whether it was the last
// one. If each body has one share, a group takes shares in turn, of bodies that move. Else it has one.
PARAMETER(uint, share_count)
PARAMETER(uint, lists_shares)  // 1: each body has one share
PARAMETER(uint, first_half)
void count_frame_change(uint b) { quiet_body[b].frame_changes += 1u; }
#include "follow_rotation.glsl"

// Of the samples that stand for a body: rest position, then the place after the step, as in follow_rotation.glsl. Threads fetch a number
// each, and then each finds one of the sums. A thread that did all of it would take registers that large groups do not have.
shared double sample_number[6u * sample_count];
shared double sample_sum[15];  // of rest positions, of places, and of their products, as in Samples

void sum_samples() {
  uint number = gl_LocalInvocationID.x;
  if (number >= 15u) return;
  double sum = double(0);
  for (uint k = 0u; k < 6u * sample_count; k += 6u) {
    EXACT double term = number < 6u ? sample_number[k + number]
                                    : sample_number[k + number / 3u - 2u] * sample_number[k + 3u + number % 3u];
    EXACT double more = sum + term;
    sum = more;
  }
  sample_sum[number] = sum;
}

Samples summed_samples() {
  Samples s;
  s.rest_mean = LOAD3(sample_sum, 0u);
  s.moved_mean = LOAD3(sample_sum, 3u);
  s.correlation_x = LOAD3(sample_sum, 6u);
  s.correlation_y = LOAD3(sample_sum, 9u);
  s.correlation_z = LOAD3(sample_sum, 12u);
  return about_means(s);
}

#include "restate.glsl"
#ifdef KICKS_FIRST
#include "restate_force.glsl"
#else
void restate_force(uint i, uint b) {}
void take_back_force(uint i, uint k) {}
#endif

#define EACH_THREAD(n, count) for (uint n = gl_LocalInvocationID.x; n < (count); n += gl_WorkGroupSize.x)
#define EACH_COORDINATE(n) EACH_THREAD(n, 3u * s.vertex_count)
#define VERTEX_OF(n) (s.first_vertex + n / 3u)
#define AXIS_OF(n) (n % 3u)

bool serves_first(Share s) { return s.first_vertex == s.body.first_vertex; }
bool leads(Share s) { return gl_LocalInvocationID.x == 0u && serves_first(s); }

uint before_step(uint i) { return in_half(from_half, vertex_count, i); }
uint after_step(uint i) { return in_half(other_half(from_half), vertex_count, i); }
dvec3 velocity_in(uint place) { return LOAD3(motion, velocity_of(place)); }
dvec3 way_in_frame(uint i) {
  return LOAD3(motion, displacement_of(after_step(i))) - LOAD3(motion, displacement_of(before_step(i)));
}

#ifdef IMPULSES
#include "quiet_surplus.glsl"
#else
void look_at_vertex(uint i, uint k, uint b) {}
void keep_surplus(uint i, uint k, uint b) {}
#endif

// Whether the step left an undeformed body where it was. That it comes to rest is left to other steps.
bool is_left_where_it_was(IN(Share) s, uint b) {
  uint first = s.body.first_vertex;
  return LOAD3(frame.gravity, 0u) == dvec3(0) && way_in_frame(first) == dvec3(0) &&
         velocity_in(before_step(first)) == dvec3(0) && velocity_in(after_step(first)) == dvec3(0);
}

void tell_first(Share s) {
  if (!serves_first(s)) return;
  uint at = displacement_of(after_step(s.body.first_vertex));
  EACH_THREAD(n, motion_size) quiet_body[s.body_index].first_motion[motion_size * other_half(from_half) + n] = motion[at + n];
}

uint sample_at(uint n) { return 3u * sample_count * (step_index & 1u) + n; }
void tell_samples(Share s) {
  EACH_THREAD(n, 3u * sample_count) {
    uint i = sample_vertex(s.body.first_vertex, s.body.vertex_count, n / 3u);
    if (i >= s.first_vertex && i < s.first_vertex + s.vertex_count)
      quiet_body[s.body_index].samples[sample_at(n)] = motion[displacement_of(after_step(i)) + n % 3u];
  }
}

void fetch_samples(IN(Body) material, uint b) {
  EACH_THREAD(n, 3u * sample_count) {
    uint i = sample_vertex(material.first_vertex, material.vertex_count, n / 3u), k = n % 3u, at = 6u * (n / 3u) + k;
    double rest = double(rest_position[i][int(k)]);
    sample_number[at] = rest;
    sample_number[at + 3u] = place_of_sample(rest, quiet_body[b].samples[sample_at(n)], pose[b].reference[k]);
  }
}

const uint no_share = 0xffffffffu;
uint share_at_hand = no_share;  // the one whose body has been fetched for the next step

void make_step(uint number, Share s) {
  uint b = s.body_index;
  barrier();  // shared memory changes from here on
  if (!runs(s)) return;
  if (share_at_hand != number) {
    fetch_body(b, from_half);
    share_at_hand = number;
    barrier();
  }
  if (serves_first(s)) EACH_THREAD(k, 3u) quiet_body[b].reference_before[k] = frame.reference[k];
#ifdef KICKS_FIRST
  EACH_COORDINATE(n) {
    note_force(VERTEX_OF(n), AXIS_OF(n));
    store_first_kick(VERTEX_OF(n), AXIS_OF(n), s.body, first_kick_of(VERTEX_OF(n), AXIS_OF(n), b, s.body));
  }
#endif
  memoryBarrierBuffer();
  barrier();
  serve_stages(s);
  memoryBarrierBuffer();
  barrier();
  EACH_COORDINATE(n) look_at_vertex(VERTEX_OF(n), AXIS_OF(n), b);
  tell_first(s);
  if (group_sums) tell_samples(s);
  if (group_sums || !leads(s) || !is_left_where_it_was(s, b)) return;
  status[b].calm = 1u;
  end_with_step();
}

shared bool frame_turns;

// The step stands. Each group of the body finds whether its frame turns. It does not while all vertices move alike.
void end_step_of(uint number, Share s) {
  uint b = s.body_index;
  if (!runs(s)) return;
  bool may_turn = deformed(s);
  barrier();  // shared memory changes from here on
  fetch_body(b, other_half(from_half));
  share_at_hand = number;
  if (may_turn) fetch_samples(s.body, b);
  barrier();
  if (!may_turn) {
    EACH_COORDINATE(n) keep_surplus(VERTEX_OF(n), AXIS_OF(n), b);
    return;
  }
  sum_samples();
  barrier();
  if (gl_LocalInvocationID.x == gl_WorkGroupSize.x - 1u) frame_turns = has_turned(summed_samples());
  EACH_COORDINATE(n) keep_surplus(VERTEX_OF(n), AXIS_OF(n), b);
  barrier();
  if (!frame_turns) return;
  share_at_hand = no_share;
  meet_others(s);
  if (leads(s)) follow_rotation(b, s.body.first_vertex, summed_samples(), LOAD3(frame.reference, 0u));
  meet_others(s);
  EACH_THREAD(n, s.vertex_count) {
    restate(s.first_vertex + n, b, s.body.inverse_unit);
    restate_force(s.first_vertex + n, b);
  }
  memoryBarrierBuffer();
  barrier();
  tell_first(s);
  meet_others(s);
}

// Motions have a half for the step's start, and kept forces were noted. The placement there and what it is relative to are found again.
void undo_step(Share s) {
  uint b = s.body_index;
  if (!runs(s)) return;
  EACH_COORDINATE(n) {
    uint i = VERTEX_OF(n), k = AXIS_OF(n);
    double relative = motion[displacement_of(before_step(i)) + k] - quiet_body[b].reference_before[k];
    place(start_slot, i, k, s.body.inverse_unit, double(rest_position[i][int(k)]), relative);
    take_back_force(i, k);
  }
  if (serves_first(s)) EACH_THREAD(k, 3u) pose[b].reference[k] = quiet_body[b].reference_before[k];
  if (leads(s)) status[b].calm = 0u;
}

shared uint end_seen, undone_seen;
uint meetings_of_all = 0u;

// Others may be a step ahead by the time that news are read, and may have more of them, but only of later steps.
void meet_all(uint groups) {
  ++meetings_of_all;
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    uint polls = 0u, seen = atomicAdd(quiet_steps[0].arrivals, 1u) + 1u;
    while ((seen & ~has_news) < groups * meetings_of_all && polls < most_polls) {
      seen = atomicAdd(quiet_steps[0].arrivals, 0u);
      ++polls;
    }
    if (polls == most_polls) atomicOr(quiet_steps[0].arrivals, waited_in_vain);  // the others need not wait, either
    memoryBarrierBuffer();
    if ((seen & has_news) != 0u) {
      end_seen = atomicAdd(quiet_steps[0].end, 0u);
      undone_seen = atomicAdd(quiet_steps[0].undone, 0u);
    }
    if (polls == most_polls || (seen & waited_in_vain) != 0u) end_seen = 0u;
  }
  barrier();
}

// Groups meet before they change anything. If they do not all run at once, they make no step.
#include "was_stopped.glsl"
#define EACH_SHARE(k) for (uint k = group; k < count; k += groups)
#define SHARE(k) share[k == group ? own : quiet_body[k].moving_share]
void make_quiet_steps(uint group) {
  uint count = lists_shares != 0u ? quiet_steps[0].moving_bodies : share_count, groups = min(count, item_count);
  if (count == 0u && group == 0u && gl_LocalInvocationID.x == 0u) quiet_steps[0].begun = 1u;  // with nobody to meet
  if (group >= groups) return;
  if (gl_LocalInvocationID.x == 0u) {
    end_seen = atomicAdd(quiet_steps[0].end, 0u);
    undone_seen = ~0u;
  }
  barrier();
  if (end_seen == 0u) return;
  uint own = lists_shares != 0u ? quiet_body[group].moving_share : first_share + group;
  barrier();
  meet_all(groups);
  bool goes_on = end_seen > 0u;
  if (goes_on && gl_LocalInvocationID.x == 0u) atomicOr(quiet_steps[0].begun, 1u);
  for (step_index = 0u; goes_on; ++step_index) {
    from_half = (first_half + step_index) & 1u;
    EACH_SHARE(k) make_step(k, SHARE(k));
    meet_all(groups);
    if (undone_seen <= step_index) {
      EACH_SHARE(k) undo_step(SHARE(k));
    } else {
      EACH_SHARE(k) end_step_of(k, SHARE(k));
    }
    goes_on = undone_seen > step_index && end_seen > step_index + 1u;
  }
  if (was_stopped(share_count)) atomicOr(quiet_steps[0].arrivals, waited_in_vain);
}
