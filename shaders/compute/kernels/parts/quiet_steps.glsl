// Runs quiet steps. All groups make a step, each for its shares of bodies that move, and meet. Then they know whether it stands, and
// whether it was the last one. If each body has one share, a group takes shares in turn. Else it has one, because those of a body wait for
// each other.
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
#ifdef HAS_FIRST_KICK
#include "restate_force.glsl"
#else
void restate_force(uint i, uint b) {}
void note_force(uint i, uint k) {}
void take_back_force(uint i, uint k) {}
#endif

#define EACH_THREAD(n, count) for (uint n = gl_LocalInvocationID.x; n < (count); n += gl_WorkGroupSize.x)

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
#include "quiet_star.glsl"
#else
const uint watches_stars = 0u;
void prove_star(Share s) {}
void find_surplus(Share s) {}
void look_at_vertices(Share s) {}
void keep_surplus(Share s) {}
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
    double reference = quiet_body[b].reference[3u * other_half(from_half) + k];
    sample_number[at + 3u] = place_of_sample(rest, quiet_body[b].samples[sample_at(n)], reference);
  }
}

shared Share served;
uint taken_up = ~0u;  // its number

// Has the group serve this share. Returns false if it does already.
bool take_up(uint number, uint own) {
  if (taken_up == number) return false;
  taken_up = number;
  barrier();  // shared memory changes from here on
  if (gl_LocalInvocationID.x == 0u) {
    served = share[own];
    ask(served);
  }
  barrier();
  return true;
}

// What a step does before its stages. What the body is like from `from_half` on has been fetched.
void begin_step(Share s) {
  EACH_KEPT(n) note_force(VERTEX_OF(n), AXIS_OF(n));
  make_first_kick(s);
}

void begin_next_step(Share s) {
  from_half = other_half(from_half);
  begin_step(s);
  from_half = other_half(from_half);
}

void make_step(Share s) {
  run_stages(s);
  meet_group();
  look_at_vertices(s);
  tell_first(s);
  if (group_sums) tell_samples(s);
  if (group_sums || !leads(s) || !is_left_where_it_was(s, s.body_index)) return;
  status[s.body_index].calm = 1u;
  end_with_step();
}

shared bool frame_turns;

// Each group of the body finds whether its frame turns. It does not while all vertices move alike. Nobody waits for the answer: the next
// step begins, and begins anew if the frame turns.
void end_step_of(Share s, bool is_new, bool goes_on) {
  uint b = s.body_index;
  fetch_body(b, other_half(from_half));
  if (group_sums) fetch_samples(s.body, b);
  barrier();
  if (group_sums) sum_samples();
  if (is_new) find_surplus(s);  // else make_step has left it in shared memory
  keep_surplus(s);
  barrier();
  if (group_sums && gl_LocalInvocationID.x == 0u) frame_turns = has_turned(summed_samples());
  if (goes_on) begin_next_step(s);
  if (!group_sums) return;
  barrier();
  if (!frame_turns) return;
  meet_others(s);
  if (leads(s)) follow_rotation(b, s.body.first_vertex, summed_samples(), LOAD3(frame.reference, 0u));
  meet_others(s);
  EACH_THREAD(n, s.vertex_count) {
    restate(s.first_vertex + n, b, s.body.inverse_unit);
    restate_force(s.first_vertex + n, b);
  }
  meet_group();
  tell_first(s);
  if (leads(s)) STORE3(quiet_body[b].reference, 3u * other_half(from_half), LOAD3(pose[b].reference, 0u))
  meet_others(s);
  fetch_body(b, other_half(from_half));
  barrier();
  if (goes_on) begin_next_step(s);
}

// Motions have a half for the step's start, and kept forces were noted. The placement there and what it is relative to are found again.
void undo_step(Share s) {
  uint b = s.body_index;
  EACH_KEPT(n) {
    uint i = VERTEX_OF(n), k = AXIS_OF(n);
    double relative = motion[displacement_of(before_step(i)) + k] - quiet_body[b].reference[3u * from_half + k];
    place(start_slot, i, k, s.body.inverse_unit, double(rest_position[i][int(k)]), relative);
    take_back_force(i, k);
  }
  if (serves_first(s)) EACH_THREAD(k, 3u) pose[b].reference[k] = quiet_body[b].reference[3u * from_half + k];
  if (leads(s)) status[b].calm = 0u;
}

shared uint end_seen, undone_seen;
uint meetings_of_all = 0u;

// Others may be a step ahead by the time that news are read, and may have more of them, but only of later steps.
void meet_all(uint groups) {
  ++meetings_of_all;
  meet_group();
  if (gl_LocalInvocationID.x == 0u) {
    memoryBarrierBuffer();
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

#include "was_stopped.glsl"
// Steps have one length, so this is done once.
void set_step_length() {
  step_length = control[0].time_step;
#ifdef HAS_FIRST_KICK
  part_at_hand = part_of(step_length);
#endif
}

// Groups meet before they change anything. If they do not all run at once, they make no step.
#define EACH_SHARE(k) for (uint k = group; k < count; k += groups)
#define TAKE_UP(k) take_up(k, k == group ? own : quiet_body[k].moving_share)
void make_quiet_steps(uint group) {
  uint count = quiet_steps[0].moving_shares, groups = min(count, item_count);
  if (count == 0u && group == 0u && gl_LocalInvocationID.x == 0u) quiet_steps[0].begun = 1u;  // with nobody to meet
  if (group >= groups) return;
  if (gl_LocalInvocationID.x == 0u) {
    end_seen = atomicAdd(quiet_steps[0].end, 0u);
    undone_seen = ~0u;
  }
  barrier();
  if (end_seen == 0u) return;
  uint own = quiet_body[group].moving_share;
  barrier();
  meet_all(groups);
  bool goes_on = end_seen > 0u;
  if (goes_on && gl_LocalInvocationID.x == 0u) atomicOr(quiet_steps[0].begun, 1u);
  from_half = first_half;
  if (gl_LocalInvocationID.x == 0u) set_step_length();
  if (goes_on) EACH_SHARE(k) {
    TAKE_UP(k);
    if (!group_runs) continue;
    fetch_body(served.body_index, from_half);
    barrier();
    begin_step(served);
  }
  for (step_index = 0u; goes_on; ++step_index) {
    EACH_SHARE(k) {
      bool is_new = TAKE_UP(k);
      if (!group_runs) continue;
      if (is_new) {
        fetch_body(served.body_index, from_half);
        barrier();
      }
      make_step(served);
    }
    meet_all(groups);
    if (watches_stars != 0u) {
      EACH_SHARE(k) {
        TAKE_UP(k);
        if (group_runs && group_sums) prove_star(served);
      }
      meet_all(groups);
    }
    bool stands = undone_seen > step_index;
    goes_on = stands && end_seen > step_index + 1u;
    EACH_SHARE(k) {
      bool is_new = TAKE_UP(k);
      if (!group_runs) continue;
      if (!stands) {
        undo_step(served);
        continue;
      }
      end_step_of(served, is_new, goes_on);
    }
    from_half = other_half(from_half);
  }
  if (was_stopped(item_count)) atomicOr(quiet_steps[0].arrivals, waited_in_vain);
}
