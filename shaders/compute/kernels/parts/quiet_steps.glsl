// Runs quiet steps. All groups make a step, each for its shares, and meet. Then they know whether it stands, and whether it was the last
// one. A group has several shares if each body has one.
WRITE(surplus)
SHARED_WRITE(frame_change)
PARAMETER(uint, share_count)
PARAMETER(uint, first_half)
void count_frame_change(uint b) { quiet_body[b].frame_changes += 1u; }
#include "follow_rotation.glsl"

// Of the samples that stand for a body: rest position, then the place after the step, as in follow_rotation.glsl. Threads fetch a number
// each, and then each finds one of the sums. A thread that did all of it would take registers that large groups do not have.
shared double sample_number[6u * sample_count];
shared double sample_sum[15];  // of rest positions, of places, and of their products, as in Samples

void fetch_samples(IN(Body) material, dvec3 origin) {
  for (uint number = gl_LocalInvocationID.x; number < 6u * sample_count; number += gl_WorkGroupSize.x) {
    uint i = sample_vertex(material.first_vertex, material.vertex_count, number / 6u), k = number % 6u;
    double rest = double(rest_position[i][int(k % 3u)]);
    uint displacement = displacement_of(in_half(other_half(from_half), vertex_count, i)) + k % 3u;
    sample_number[number] = k < 3u ? rest : place_of_sample(rest, motion[displacement], origin[int(k % 3u)]);
  }
}

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
#endif

#define EACH_OWN(i) \
  for (uint i = s.first_vertex + gl_LocalInvocationID.x; i < s.first_vertex + s.vertex_count; i += gl_WorkGroupSize.x)
#define POSE_BEFORE quiet_body[b].before[step_index & 1u]
#define COPY_POSE(from, to)                                           \
  for (uint k = 0u; k < 3u; ++k) {                                    \
    to.origin[k] = from.origin[k];                                    \
    to.gravity[k] = from.gravity[k];                                  \
    to.reference[k] = from.reference[k];                              \
  }                                                                   \
  for (uint k = 0u; k < 4u; ++k) to.quaternion[k] = from.quaternion[k]; \
  for (uint k = 0u; k < 9u; ++k) to.rotation[k] = from.rotation[k];

bool leads(Share s) { return gl_LocalInvocationID.x == 0u && s.first_vertex == s.body.first_vertex; }

void keep_pose(uint b) { COPY_POSE(pose[b], POSE_BEFORE) }
void restore_pose(uint b) { COPY_POSE(POSE_BEFORE, pose[b]) }

// One component in the world of a vector of the frame. A member of an array that others write is not passed on: NVIDIA's driver 580
// fails then.
double turned_before(uint b, uint k, dvec3 p) {
  return row_times(POSE_BEFORE.rotation[3u * k], POSE_BEFORE.rotation[3u * k + 1u], POSE_BEFORE.rotation[3u * k + 2u], p);
}

dvec3 velocity_in(uint half_index, uint i) { return LOAD3(motion, velocity_of(in_half(half_index, vertex_count, i))); }
dvec3 way_in_frame(uint i) {
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  return LOAD3(motion, displacement_of(after)) - LOAD3(motion, displacement_of(before));
}

// What `settle` keeps of a step for the next: the velocity that the vertex had in the step beyond that at the start, in the frame [m/s].
dvec3 surplus_in_frame(uint i, dvec3 gone) { return gone / control[0].time_step - velocity_in(from_half, i); }

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then. One
// axis at a time takes fewer registers, of which a large group has few.
void look_at_vertex(uint i, uint b) {
  dvec3 gone = way_in_frame(i), in_frame = surplus_in_frame(i, gone), first = velocity_in(from_half, i);
  dvec3 last = velocity_in(other_half(from_half), i);
  double room = double(quiet_body[b].room);
  bool stays = true, goes_on = true;
  for (uint k = 0u; k < 3u; ++k) {
    double latest = surplus[surplus_of(0u, vertex_count, i) + k], oldest = surplus[surplus_of(1u, vertex_count, i) + k];
    double along = turned_before(b, k, gone), next = turned_before(b, k, in_frame);
    double expected = control[0].time_step * (turned_before(b, k, first) + (latest + double(0.5) * (latest - oldest)));
    double speed = turned_before(b, k, last) + (next + double(0.5) * (next - latest));
    stays = stays && along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
    goes_on = goes_on && speed > double(quiet_body[b].least_velocity[k]) && speed < double(quiet_body[b].most_velocity[k]);
  }
  if (!stays) atomicMin(quiet_steps[0].undone, step_index);
  if (!goes_on) atomicMin(quiet_steps[0].end, step_index + 1u);
}

void keep_surplus(uint i, uint b) {
  dvec3 in_frame = surplus_in_frame(i, way_in_frame(i));
  for (uint k = 0u; k < 3u; ++k) {
    surplus[surplus_of(1u, vertex_count, i) + k] = surplus[surplus_of(0u, vertex_count, i) + k];
    surplus[surplus_of(0u, vertex_count, i) + k] = turned_before(b, k, in_frame);
  }
}

// Whether the step left an undeformed body where it was. That it comes to rest is left to other steps.
bool is_left_where_it_was(IN(Share) s, uint b) {
  uint first = s.body.first_vertex;
  return status[b].deformed == 0u && LOAD3(pose[b].gravity, 0u) == dvec3(0) && way_in_frame(first) == dvec3(0) &&
         velocity_in(0u, first) == dvec3(0) && velocity_in(1u, first) == dvec3(0);
}

void follow_body(Share s, uint b) {
  frame_change[b].turned = 0u;
  if (is_left_where_it_was(s, b)) {
    status[b].calm = 1u;
    atomicMin(quiet_steps[0].end, step_index + 1u);
  }
  follow_rotation(b, s.body.first_vertex, summed_samples(), LOAD3(pose[b].reference, 0u));
}

void make_step(Share s) {
  uint b = s.body_index;
  barrier();  // shared memory changes from here on
  if (!runs(s)) return;
  if (leads(s)) keep_pose(b);
#ifdef KICKS_FIRST
  EACH_OWN(i) kick_first(i, b, s.body);
#endif
  memoryBarrierBuffer();
  barrier();
  serve_stages(s);
  memoryBarrierBuffer();
  barrier();
  EACH_OWN(i) look_at_vertex(i, b);
  meet_others(s);
  if (s.first_vertex != s.body.first_vertex) return;
  fetch_samples(s.body, LOAD3(pose[b].reference, 0u));
  barrier();
  sum_samples();
  barrier();
  if (leads(s)) follow_body(s, b);
}

shared bool frame_turned;

void end_step_of(Share s) {
  uint b = s.body_index;
  if (!runs(s)) return;
  barrier();
  if (gl_LocalInvocationID.x == 0u) frame_turned = frame_change[b].turned != 0u;
  barrier();
  EACH_OWN(i) {
    keep_surplus(i, b);
    if (!frame_turned) continue;
    restate(i, b, s.body.inverse_unit);
    restate_force(i, b);
  }
  if (frame_turned) meet_others(s);
}

// The step's start is as it was: what stood there alone is the placement, and the pose.
void undo_step(Share s) {
  uint b = s.body_index;
  if (!runs(s)) return;
  EACH_OWN(i) {
    dvec3 displacement = LOAD3(motion, displacement_of(in_half(from_half, vertex_count, i)));
    for (uint k = 0u; k < 3u; ++k)
      place(start_slot, i, k, s.body.inverse_unit, double(rest_position[i][int(k)]), displacement[int(k)] - POSE_BEFORE.reference[k]);
  }
  if (!leads(s)) return;
  if (frame_change[b].turned != 0u) quiet_body[b].frame_changes -= 1u;
  status[b].calm = 0u;
  restore_pose(b);
}

shared uint end_seen, undone_seen;
uint meetings_of_all = 0u;

// Others may be a step ahead by the time that these are read, and may have changed them, but only to later steps.
void meet_all(uint groups) {
  ++meetings_of_all;
  memoryBarrierBuffer();
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    uint polls = 0u;
    atomicAdd(quiet_steps[0].arrivals, 1u);
    while (atomicAdd(quiet_steps[0].arrivals, 0u) < groups * meetings_of_all && polls < most_polls) ++polls;
    if (polls == most_polls) atomicOr(quiet_steps[0].arrivals, waited_in_vain);  // the others need not wait, either
    memoryBarrierBuffer();
    bool failed = (atomicAdd(quiet_steps[0].arrivals, 0u) & waited_in_vain) != 0u;
    end_seen = failed ? 0u : atomicAdd(quiet_steps[0].end, 0u);
    undone_seen = atomicAdd(quiet_steps[0].undone, 0u);
  }
  barrier();
}

// Groups meet before they change anything. If they do not all run at once, they make no step.
#define EACH_SHARE(k) for (uint k = group; k < share_count; k += groups)
void make_quiet_steps(uint group, uint groups) {
  if (gl_LocalInvocationID.x == 0u) end_seen = atomicAdd(quiet_steps[0].end, 0u);
  barrier();
  if (end_seen == 0u) return;
  barrier();
  meet_all(groups);
  bool goes_on = end_seen > 0u;
  if (goes_on && gl_LocalInvocationID.x == 0u) atomicOr(quiet_steps[0].begun, 1u);
  for (step_index = 0u; goes_on; ++step_index) {
    from_half = (first_half + step_index) & 1u;
    EACH_SHARE(k) make_step(share[first_share + k]);
    meet_all(groups);
    if (undone_seen <= step_index) {
      EACH_SHARE(k) undo_step(share[first_share + k]);
    } else {
      EACH_SHARE(k) end_step_of(share[first_share + k]);
    }
    goes_on = undone_seen > step_index && end_seen > step_index + 1u;
  }
}
