// The memory of one work group. It keeps sums of impulses and notes while the group serves all contacts alone (rounds.comp). There a vertex
// has a place, which is found by its number.
#define NEAR_ROUNDS
#define GROUP_SIZE 512u
const uint near_items = GROUP_SIZE;  // contacts, one a thread
const uint far_threads = 32u;        // of a group, where several share the contacts. On an H200 64 took longer
const uint near_places = (SHARED_BYTES - 64u) / (4u + 24u * sum_buffers);
const uint most_near_vertices = near_places - near_places / 8u;  // fuller, it would take long to find a place
shared uint near_vertex[near_places];
shared int near_high[3u * sum_buffers * near_places];
shared int near_low[3u * sum_buffers * near_places];
shared uint near_vertex_count;
shared uint near_presses;
shared uint near_unsettled_round;
shared uint near_bounces_from;
shared uint near_bounce_round;
shared uint asked_too_much;
bool sums_are_near = false;  // the same in all threads

// Runs this in the group's own memory, and otherwise what follows.
#define NEAR_ELSE(statement) if (sums_are_near) { statement } else

uint first_place_of(uint i) { return (i * 2654435761u >> 7u) % near_places; }
uint place_after(uint place) { return place + 1u == near_places ? 0u : place + 1u; }

uint near_place_of(uint i) {
  uint place = first_place_of(i);
  while (near_vertex[place] != i) place = place_after(place);
  return place;
}

// Whether all vertices so far fit. Their number alone decides, and not their order.
bool have_places() { return near_vertex_count <= most_near_vertices; }

void give_place(uint i) {
  if (i == no_vertex) return;
  uint place = first_place_of(i);
  for (uint k = 0u; k < near_places && have_places(); ++k) {
    uint before = atomicCompSwap(near_vertex[place], no_vertex, i);
    if (before == no_vertex) atomicAdd(near_vertex_count, 1u);
    if (before == no_vertex || before == i) return;
    place = place_after(place);
  }
}

void clear_near(uint buffer_index) {
  uint first = impulse_sum_of(buffer_index, near_places, 0u);
  for (uint k = gl_LocalInvocationID.x; k < 3u * near_places; k += GROUP_SIZE) {
    near_high[first + k] = 0;
    near_low[first + k] = 0;
  }
}

// Whether a contact asks for so much that sums might grow beyond their room. A vertex at the largest speed has up to 2^47 quanta. Asked for
// 4 times as much, and twice that after a bounce, its sums have 2^50, and room for 2^52.
bool asks_much(uint c) {
  real4 goal = contact_row[contact_rows * c + 2u], impulse = impulse_row[c];
  real change = abs(contact_row[contact_rows * c].w) + length(real3(goal));
  real most = real(4) * real(largest_speed());
  return !(change <= most && length(impulse) <= most * real(heaviest_vertex()));
}

// All threads of the one group call it before the first round.
void begin_near(uint count) {
  for (uint k = gl_LocalInvocationID.x; k < near_places; k += GROUP_SIZE) near_vertex[k] = no_vertex;
  for (uint k = 0u; k < sum_buffers; ++k) clear_near(k);
  if (gl_LocalInvocationID.x == 0u) {
    near_vertex_count = 0u;
    near_presses = 0u;
    near_unsettled_round = 0u;
    near_bounces_from = no_round;
    near_bounce_round = no_round;
    asked_too_much = 0u;
  }
  memoryBarrierShared();
  barrier();
  if (gl_LocalInvocationID.x < count)
    for (int k = 0; k < 4; ++k) give_place(contact_vertex[gl_LocalInvocationID.x][k]);
  if (gl_LocalInvocationID.x < count && asks_much(gl_LocalInvocationID.x)) asked_too_much = 1u;
  memoryBarrierShared();
  barrier();
  sums_are_near = have_places() && asked_too_much == 0u;
}

// All threads of the one group call it after each round.
void end_near_round(uint kick_round) {
  clear_near(buffer_of(kick_round + 2u));
  memoryBarrierShared();
  barrier();
}

// A place has three sums, each high * 2^21 + low. The low parts of 512 contacts need no carry. A high part has room for 2^52 quanta.
const real limb = real(2097152);
const real most_high = real(1073741824);  // of one contact. Beyond, its impulse is cut down, on both bodies alike

real3 near_impulse(uint at) {
  ivec3 high = ivec3(near_high[at], near_high[at + 1u], near_high[at + 2u]);
  ivec3 low = ivec3(near_low[at], near_low[at + 1u], near_low[at + 2u]);
  return limb * real3(high) + real3(low);
}
dvec3 near_exact_impulse(uint at) {
  dvec3 high = dvec3(near_high[at], near_high[at + 1u], near_high[at + 2u]);
  return double(limb) * high + dvec3(near_low[at], near_low[at + 1u], near_low[at + 2u]);
}

struct NearQuanta {
  ivec3 high;
  ivec3 low;
};

NearQuanta near_quanta_of(real3 impulse) {
  real3 high = floor(impulse * (real(1) / limb) + real3(0.5));
  NearQuanta quanta;
  quanta.high = ivec3(clamp(high, -most_high, most_high));
  quanta.low = ivec3(floor((impulse - limb * high) + real3(0.5)));
  return quanta;
}

void add_near(uint at, NearQuanta quanta) {
  atomicAdd(near_high[at], quanta.high.x);
  atomicAdd(near_high[at + 1u], quanta.high.y);
  atomicAdd(near_high[at + 2u], quanta.high.z);
  atomicAdd(near_low[at], quanta.low.x);
  atomicAdd(near_low[at + 1u], quanta.low.y);
  atomicAdd(near_low[at + 2u], quanta.low.z);
}

void push_apart_near(uvec4 at, real3 of_y, real3 of_z, real3 of_w) {
  NearQuanta y = near_quanta_of(of_y), z = near_quanta_of(of_z), w = near_quanta_of(of_w), x;
  x.high = -(y.high + z.high + w.high);
  x.low = -(y.low + z.low + w.low);
  add_near(at.x, x);
  add_near(at.y, y);
  add_near(at.z, z);
  add_near(at.w, w);
}
