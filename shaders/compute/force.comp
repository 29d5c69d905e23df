// The frame around a force kernel. One work group of TEAMS teams serves one share. A team has VERTICES vertices and LANES threads, its
// lanes. One lane takes every LANES-th vertex of the body and adds its springs to all vertices of the team. What it loads once thus
// serves VERTICES pairs. The lanes' sums meet in shared memory. Other threads of the group are keepers, one for each coordinate.
// Meanwhile they load what else is needed, and then they finish the vertices.
// With GIVEN_SUMS other passes have summed the springs, and there are only keepers.
// With LANES = 1, for small bodies and for devices without parallel lanes, one thread serves its own vertices alone.
//
// With TILE the kernel runs all stages of a step in one dispatch. Between two stages the groups of a body wait for each other, which
// costs a third of a dispatch. If a body has several, all of them must run at once. A group's own caches do not see what others write
// meanwhile. The group therefore fetches the body's vertices into shared memory, TILE at a time.
#version 450
#include "physics/language.glsl"
// Threads that serve several vertices have no registers left for this. They serve large bodies best, where rounding averages out.
// Lanes::cancels_rounding() says the same.
#define CANCELS_ROUNDING (VERTICES == 1 || LANES == 1)
#include "@kernel"

#ifdef GIVEN_SUMS
layout(local_size_x = KEEPERS) in;
#else
// Repeats f for each of a thread's vertices. Arrays would end up in memory, because compilers index them before they unroll.
#if VERTICES == 1
#define EACH(f) f(0)
#elif VERTICES == 2
#define EACH(f) f(0) f(1)
#elif VERTICES == 4
#define EACH(f) f(0) f(1) f(2) f(3)
#else
#error VERTICES is 1, 2 or 4
#endif

#ifdef TILE
#if TILE % (PLAINLY * LANES) != 0
#error TILE is a multiple of PLAINLY LANES, so that sums are the same bits as without
#endif
shared vec4 seen[TILE];         // x, and u.x
shared vec2 seen_beside[TILE];  // u.y, u.z
#endif
#if LANES == 1
layout(local_size_x = TEAMS) in;
#else
#if LANES % 16 != 0 && LANES != 8
#error LANES is 1, or a multiple of 2 runs_of_lanes
#endif
const uint runs_of_lanes = min(LANES / 2u, 8u);
layout(local_size_x = LANES * TEAMS + KEEPERS) in;
shared float partial_sum[3u * VERTICES * TEAMS * LANES];  // [axis][vertex][lane], later runs' totals and rests as sum_run() leaves them
#endif
#endif  // GIVEN_SUMS
PARAMETER(uint, item_count)  // shares

#ifndef GIVEN_SUMS
// Adds `sum` to `total`. `rest` collects what rounding takes from the total. Knuth's summation finds that exactly, but needs registers
// that threads with several vertices do not have. Those use Kahan's summation.
#if VERTICES > 1 && LANES > 1
void add(inout vec3 total, inout vec3 rest, vec3 sum) {
  EXACT vec3 added = sum + rest;
  EXACT vec3 grown = total + added;
  EXACT vec3 lost = added - (grown - total);
  rest = lost;
  total = grown;
}
#else
void add(inout vec3 total, inout vec3 rest, vec3 sum) {
  EXACT vec3 grown = total + sum;
  EXACT vec3 arrived = grown - total;
  EXACT vec3 lost = (total - (grown - arrived)) + (sum - arrived);
  rest = rest + lost;
  total = grown;
}
#endif

void add_spring(inout vec3 sum, vec3 x, vec3 d, float weight) {
  float strain = weight * spring_strain(x, d);
  sum = vec3(FUSED(strain, x.x, sum.x), FUSED(strain, x.y, sum.y), FUSED(strain, x.z, sum.z));
}

uint placed_from() { return position_at(placement_slot(), vertex_count, 0u); }
uint vertex_of(Share s, uint place) { return s.first_vertex + min(place, s.vertex_count - 1u); }

// If a team is one thread, neighbouring threads serve neighbouring vertices, so that their loads are neighbours too.
#if LANES == 1
#define PLACE(k) (team + uint(k) * TEAMS)
#else
#define PLACE(k) (team * VERTICES + uint(k))
#endif
#define OWN(k)                                                      \
  uint own##k = base + vertex_of(s, PLACE(k));                      \
  vec3 x##k = placed[own##k].xyz, u##k = placed[own##k + vertex_count].xyz, total##k = vec3(0), rest##k = vec3(0), sum##k;
#define CLEAR(k) sum##k = vec3(0);
#define PAIR(k) add_spring(sum##k, x##k - other_x, u##k - other_u, weight);
#define CLOSE(k) add(total##k, rest##k, sum##k);

#ifdef TILE
#define SEE(j) vec3 other_x = seen[j].xyz, other_u = vec3(seen[j].w, seen_beside[j]);
#else
#define SEE(j) vec3 other_x = placed[j].xyz, other_u = placed[(j) + vertex_count].xyz;
#endif

// WHOLE adds the springs to vertex j + q LANES. PART does so only if that vertex stands before `stop`.
#define WHOLE(q)                                      \
  {                                                   \
    const float weight = 1.0;                         \
    SEE(j + q * LANES)                                \
    EACH(PAIR)                                        \
  }
#define PART(q)                                       \
  {                                                   \
    uint other = min(j + q * LANES, stop - 1u);       \
    float weight = j + q * LANES < stop ? 1.0 : 0.0;  \
    SEE(other)                                        \
    EACH(PAIR)                                        \
  }
#if UNROLL == 2
#define UNROLLED(f) f(0u) f(1u)
#elif UNROLL == 3
#define UNROLLED(f) f(0u) f(1u) f(2u)
#elif UNROLL == 4
#define UNROLLED(f) f(0u) f(1u) f(2u) f(3u)
#else
#error UNROLL is 2, 3 or 4
#endif

// Adds springs to every LANES-th vertex between `first` and `end`, from `lane` on. PLAINLY springs are added plainly, and those sums
// exactly. Springs come UNROLL at a time, so that their loads overlap. So do the last ones, if need be with some left out.
//
// Two vertices get the very same bits from their spring, with opposite signs. If the forces on a body do not add up to zero, the
// rounding of sums alone is to blame. It is what counts, because nothing holds a body back from drifting and turning. A trajectory's
// error grows with the number of steps to the power 3/2. A single lane therefore closes its sums early. Many lanes' roundings cancel.
#if PLAINLY % UNROLL != 0
#error PLAINLY is a multiple of UNROLL
#endif
const uint stride = PLAINLY * LANES;
#define SUM_SPRINGS(first, end)                                                                     \
  for (uint begin = first + lane; begin < end; begin += stride) {                                   \
    uint stop = min(begin + stride, end), j = begin;                                                \
    EACH(CLEAR)                                                                                     \
    for (; j + (UNROLL - 1u) * LANES < stop; j += UNROLL * LANES) { UNROLLED(WHOLE) }               \
    if (j < stop) { UNROLLED(PART) }                                                                \
    EACH(CLOSE)                                                                                     \
  }

#ifdef TILE
// Fetches vertices of the body into shared memory, from the group's own view of what others write. Keepers still wait for other loads.
void fetch(uint from, uint count) {
  const uint threads = LANES * TEAMS;
  for (uint j = gl_LocalInvocationID.x; j < count && gl_LocalInvocationID.x < threads; j += threads) {
    vec3 x = placed[from + j].xyz, u = placed[from + j + vertex_count].xyz;
    seen[j] = vec4(x, u.x);
    seen_beside[j] = u.yz;
  }
}
#endif
#endif  // GIVEN_SUMS

#if LANES == 1
void finish(uint i, Share s, dvec3 force) {
  Damping d = damping_by(s, ordered_dot(force, force));
  double x = after_force(i, 0u, s, force.x, d, before_force(i, 0u, s));
  double y = after_force(i, 1u, s, force.y, d, before_force(i, 1u, s));
  double z = after_force(i, 2u, s, force.z, d, before_force(i, 2u, s));
  for (uint k = 0u; k < 3u && settles(); ++k) settle(i, k, s, dvec3(x, y, z));
}

// Repeats what follows for each coordinate n of the share that this thread keeps.
#define EACH_KEPT(n) \
  for (uint n = 3u * gl_LocalInvocationID.x; n < 3u * s.vertex_count; n += n % 3u == 2u ? 3u * TEAMS - 2u : 1u)

#define FINISH(k) \
  if (PLACE(k) < s.vertex_count) finish(s.first_vertex + PLACE(k), s, (-s.body.unit_force) * (dvec3(total##k) + dvec3(rest##k)));
void prepare(Share s) {}

void serve(Share s, bool sums) {
  const uint lane = 0u;
  uint team = gl_LocalInvocationID.x, base = placed_from();
  if (team == 0u && s.first_vertex == s.body.first_vertex) count_force(s, sums);
  EACH(OWN)
#ifdef TILE
  for (uint tile = 0u; sums && tile < s.body.vertex_count; tile += TILE) {
    uint count = min(s.body.vertex_count - tile, uint(TILE));
    barrier();
    fetch(base + s.body.first_vertex + tile, count);
    barrier();
    SUM_SPRINGS(0u, count)
  }
#else
  if (sums) { SUM_SPRINGS(base + s.body.first_vertex, base + s.body.first_vertex + s.body.vertex_count) }
#endif
  EACH(FINISH)
}
#else
shared double settled[3 * VERTICES * TEAMS];

#ifdef GIVEN_SUMS
void sum_over_threads(Share s, bool sums) {}
dvec3 sum_of(Share s, uint place) { return LOAD3(spring_sum, force_of(s.first_vertex + place)); }
#else
void store_partial(uint at, vec3 sum) {
  const uint axis = VERTICES * TEAMS * LANES;
  partial_sum[at] = sum.x;
  partial_sum[at + axis] = sum.y;
  partial_sum[at + 2u * axis] = sum.z;
}

vec3 load_partial(uint at) {
  const uint axis = VERTICES * TEAMS * LANES;
  return vec3(partial_sum[at], partial_sum[at + axis], partial_sum[at + 2u * axis]);
}

#define STORE(k) store_partial(PLACE(k) * LANES + lane, total##k);
#ifdef TILE
void sum_lanes(Share s, bool sums) {
  bool adds = gl_LocalInvocationID.x < LANES * TEAMS;
  uint team = min(gl_LocalInvocationID.x / LANES, TEAMS - 1u), lane = gl_LocalInvocationID.x % LANES, base = placed_from();
  EACH(OWN)
  for (uint tile = 0u; sums && tile < s.body.vertex_count; tile += TILE) {
    uint count = min(s.body.vertex_count - tile, uint(TILE));
    fetch(base + s.body.first_vertex + tile, count);
    barrier();
    if (adds) { SUM_SPRINGS(0u, count) }
    if (tile + TILE < s.body.vertex_count) barrier();
  }
  if (adds) { EACH(STORE) }
}
#else
void sum_lanes(Share s, bool sums) {
  if (gl_LocalInvocationID.x >= LANES * TEAMS) return;
  uint team = gl_LocalInvocationID.x / LANES, lane = gl_LocalInvocationID.x % LANES, base = placed_from();
  EACH(OWN)
  if (sums) { SUM_SPRINGS(base + s.body.first_vertex, base + s.body.first_vertex + s.body.vertex_count) }
  EACH(STORE)
}
#endif

// Sums a run of lanes: lane `first` and those that follow it runs_of_lanes apart. The run's first two places keep the total and the rest.
void sum_run(uint first) {
  vec3 total = vec3(0), rest = vec3(0);
  for (uint lane = 0u; lane < LANES; lane += runs_of_lanes) add(total, rest, load_partial(first + lane));
  store_partial(first, total);
  store_partial(first + runs_of_lanes, rest);
}

dvec3 sum_of_runs(uint first) {
  dvec3 total = dvec3(0);
  for (uint k = 0u; k < runs_of_lanes; ++k)
    total += dvec3(load_partial(first + k)) + dvec3(load_partial(first + k + runs_of_lanes));
  return total;
}

void sum_over_threads(Share s, bool sums) {
  uint thread = gl_LocalInvocationID.x;
  sum_lanes(s, sums);
  barrier();
  if (thread < runs_of_lanes * VERTICES * TEAMS) sum_run(thread / runs_of_lanes * LANES + thread % runs_of_lanes);
  barrier();
}

dvec3 sum_of(Share s, uint place) { return sum_of_runs(place * LANES); }
#endif  // GIVEN_SUMS

uint keeper() { return gl_LocalInvocationID.x - LANES * TEAMS; }  // of other threads it is large, because it wraps around
bool keeps(Share s) { return keeper() < 3u * s.vertex_count; }
#define EACH_KEPT(n) for (uint n = keeper(); n < 3u * s.vertex_count; n += KEEPERS)

// Keepers load what other groups do not write.
Pending pending;
void prepare(Share s) {
  if (keeps(s)) pending = before_force(s.first_vertex + keeper() / 3u, keeper() % 3u, s);
}

void serve(Share s, bool sums) {
  uint place = keeper() / 3u, k = keeper() % 3u, i = s.first_vertex + place;
  bool is_kept = keeps(s);
#ifdef TILE
  if (sums) sum_over_threads(s, sums);
#else
  sum_over_threads(s, sums);  // threads might not agree on `sums`
#endif
  if (is_kept) {
    if (keeper() == 0u && i == s.body.first_vertex) count_force(s, sums);
    dvec3 force = (-s.body.unit_force) * (sums ? sum_of(s, place) : dvec3(0));
    double component = k == 0u ? force.x : k == 1u ? force.y : force.z;
    settled[keeper()] = after_force(i, k, s, component, damping_by(s, ordered_dot(force, force)), pending);
  }
  if (!settles()) return;
  barrier();
  if (is_kept) settle(i, k, s, dvec3(settled[3u * place], settled[3u * place + 1u], settled[3u * place + 2u]));
}
#endif

#ifdef TILE
uint meetings = 0u;

uint groups_of(Share s) {
  const uint share_size = VERTICES * TEAMS;
  return (s.body.vertex_count + share_size - 1u) / share_size;
}

// What this thread has written, others of the group may read after it. Then one thread's memoryBarrierBuffer() shows other groups what the
// whole group has written, because fences are cumulative on GPUs of NVIDIA. Other devices do not tell their number of multiprocessors, and
// no group waits for another there. Each thread that fences waits for its own writes, and that takes longer.
void meet_group() {
  groupMemoryBarrier();
  barrier();
}

// Tells the body's other groups that this one has written what they may read. Between this and wait_for_others() threads load what other
// groups do not write.
void arrive(Share s) {
  ++meetings;
  meet_group();
  if (gl_LocalInvocationID.x != 0u || groups_of(s) == 1u) return;
  memoryBarrierBuffer();
  atomicAdd(meeting[s.body_index], 1u);
}

// Waits until every group of the body has arrived as often. All of them run at once, so none waits in vain. If a driver holds some of
// them back all the same, the body halts after most_polls, and nobody waits any more.
void wait_for_others(Share s) {
  uint groups = groups_of(s), polls = 0u;
  if (groups == 1u) return;
  if (gl_LocalInvocationID.x == 0u) {
    while (atomicAdd(meeting[s.body_index], 0u) < groups * meetings && polls < most_polls) ++polls;
    if (polls == most_polls) {
      status[s.body_index].activity = halted_waiting;
      atomicOr(meeting[s.body_index], 1u << 31);
    }
    memoryBarrierBuffer();
  }
  barrier();
}

void meet_others(Share s) {
  arrive(s);
  wait_for_others(s);
}

#define VERTEX_OF(n) (s.first_vertex + n / 3u)
#define AXIS_OF(n) (n % 3u)

#ifdef HAS_FIRST_KICK
void make_first_kick(Share s) {
  EACH_KEPT(n)
    store_first_kick(VERTEX_OF(n), AXIS_OF(n), s.body,
                     first_kick_of(VERTEX_OF(n), AXIS_OF(n), s.body_index, s.body, first_decay(VERTEX_OF(n), s.body)));
}
#else
bool makes_first_kick() { return false; }
bool refreshes(Share s) { return false; }
void end_refresh(Share s) {}
void make_first_kick(Share s) {}
#endif

// One thread asks for these, so that all threads of the group go the same way.
shared bool group_runs, group_sums, group_refreshes;
void ask(Share s) {
  group_runs = runs(s);
  group_sums = deformed(s);
  group_refreshes = refreshes(s);
}

// In quiet steps the step before has made the first kick.
#ifdef QUIET
void begin_stages(Share s) {}
#else
void begin_stages(Share s) {
  if (group_refreshes) meet_group();
  if (makes_first_kick()) make_first_kick(s);
}
#endif

// All sums stand in one loop, so that their code does, too. The refresh's number is one before 0. Groups that have nothing to sum meet after
// it as well, so that all have asked for it before it ends.
void run_stages(Share s) {
  stage_index = group_refreshes ? refresh_stage : first_stage(s, group_sums);
  for (; stage_index + 1u <= stage_count; ++stage_index) {
    if (stage_index == 0u) begin_stages(s);
    bool follows_another = stage_index == 0u ? makes_first_kick() : stage_index != refresh_stage;
    bool meets = follows_another && (group_sums || group_refreshes);
    if (meets) arrive(s);
    prepare(s);
    if (meets) wait_for_others(s);
    barrier();  // shared memory changes from here on
    serve(s, group_sums);
  }
  if (group_refreshes && gl_LocalInvocationID.x == 0u) end_refresh(s);
}
#endif

#ifdef QUIET
#include "kernels/parts/quiet_steps.glsl"
void main() { make_quiet_steps(gl_WorkGroupID.x); }
#else
void serve_stages(Share s) {
#ifdef TILE
  if (gl_LocalInvocationID.x == 0u) ask(s);
  barrier();
  if (group_runs) run_stages(s);
#else
  if (!runs(s)) return;
  prepare(s);
  serve(s, deformed(s));
#endif
}

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (group < item_count) serve_stages(share[first_share + group]);
}
#endif
