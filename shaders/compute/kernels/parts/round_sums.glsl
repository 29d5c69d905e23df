// What contacts share in the rounds of a kick: sums of impulses, and notes. On a GPU one work group keeps them in its own memory if it can
// serve all contacts (near_sums.glsl). Then the place of a vertex is found by its number. Otherwise it is its number.
#include "impulse_sums.glsl"

#ifdef __cplusplus
static constexpr bool sums_are_near = false, has_own_thread = false;
#define NEAR_ELSE(statement)
#else
#include "near_sums.glsl"
#endif

uint place_of(uint i) {
  NEAR_ELSE(return i == no_vertex ? i : near_place_of(i);)
  return i;
}

// Where the sums of a place begin.
uint sum_of_place(uint place, uint buffer_index) {
  NEAR_ELSE(return impulse_sum_of(buffer_index, near_places, place);)
  return impulse_sum_of(buffer_index, vertex_count, place);
}

uvec2 far_sum(uint at) { return halves_of_sum(impulse_sum[at]); }
real3 far_impulse(uint at) {
  return real3(real_of(far_sum(at)), real_of(far_sum(at + 1u)), real_of(far_sum(at + 2u)));
}
real3 impulse_at(uint at) {
  NEAR_ELSE(return near_impulse(at);)
  return far_impulse(at);
}
// Of four places in one branch, so that a GPU waits for all of them at once.
void impulses_at(uvec4 at, OUT(real3) x, OUT(real3) y, OUT(real3) z, OUT(real3) w) {
  NEAR_ELSE(x = near_impulse(at.x); y = near_impulse(at.y); z = near_impulse(at.z); w = near_impulse(at.w);)
  {
    x = far_impulse(at.x);
    y = far_impulse(at.y);
    z = far_impulse(at.z);
    w = far_impulse(at.w);
  }
}
dvec3 exact_impulse_at(uint at) {
  NEAR_ELSE(return near_exact_impulse(at);)
  return dvec3(whole_of(far_sum(at)), whole_of(far_sum(at + 1u)), whole_of(far_sum(at + 2u)));
}

// An impulse in whole quanta, as physics/contact/exact_sum.glsl has them.
struct Quanta {
  uvec2 x;
  uvec2 y;
  uvec2 z;
};

Quanta quanta_of(real3 impulse) {
  Quanta quanta;
  quanta.x = halves_of_real(impulse.x);
  quanta.y = halves_of_real(impulse.y);
  quanta.z = halves_of_real(impulse.z);
  return quanta;
}
Quanta rest_of(Quanta a, Quanta b, Quanta c) {
  Quanta rest;
  rest.x = negative_of(sum_of(sum_of(a.x, b.x), c.x));
  rest.y = negative_of(sum_of(sum_of(a.y, b.y), c.y));
  rest.z = negative_of(sum_of(sum_of(a.z, b.z), c.z));
  return rest;
}

// All low halves are added before the high ones. There are no loops and no arrays: compilers for GPUs would wait for each addition in turn.
#ifdef ADDS_64_BITS
#define ADD_LOW_HALVES(before, at, quanta)
#define ADD_HIGH_HALVES(before, at, quanta)                      \
  {                                                              \
    atomicAdd(impulse_sum[at], packUint2x32((quanta).x));        \
    atomicAdd(impulse_sum[(at) + 1u], packUint2x32((quanta).y)); \
    atomicAdd(impulse_sum[(at) + 2u], packUint2x32((quanta).z)); \
  }
#else
#define ADD_LOW_HALVES(before, at, quanta)                                                                        \
  uvec3 before = uvec3(ADD_LOW_HALF(impulse_sum[at], (quanta).x), ADD_LOW_HALF(impulse_sum[(at) + 1u], (quanta).y), \
                       ADD_LOW_HALF(impulse_sum[(at) + 2u], (quanta).z));
#define ADD_HIGH_HALVES(before, at, quanta)                       \
  {                                                               \
    ADD_HIGH_HALF(impulse_sum[at], (quanta).x, (before).x)        \
    ADD_HIGH_HALF(impulse_sum[(at) + 1u], (quanta).y, (before).y) \
    ADD_HIGH_HALF(impulse_sum[(at) + 2u], (quanta).z, (before).z) \
  }
#endif

// Adds an impulse to the one vertex of a contact with a ground [quanta].
void push_off(uint at, IN(real3) impulse) {
  NEAR_ELSE(add_near(at, near_quanta_of(impulse));)
  {
    Quanta quanta = quanta_of(impulse);
    ADD_LOW_HALVES(before, at, quanta)
    ADD_HIGH_HALVES(before, at, quanta)
  }
}

void push_apart_far(uvec4 at, IN(real3) of_y, IN(real3) of_z, IN(real3) of_w) {
  Quanta y = quanta_of(of_y), z = quanta_of(of_z), w = quanta_of(of_w), x = rest_of(y, z, w);
  ADD_LOW_HALVES(before_x, at.x, x)
  ADD_LOW_HALVES(before_y, at.y, y)
  ADD_LOW_HALVES(before_z, at.z, z)
  ADD_LOW_HALVES(before_w, at.w, w)
  ADD_HIGH_HALVES(before_x, at.x, x)
  ADD_HIGH_HALVES(before_y, at.y, y)
  ADD_HIGH_HALVES(before_z, at.z, z)
  ADD_HIGH_HALVES(before_w, at.w, w)
}

// Adds impulses to four vertices [quanta]. The first gets what the others leave, so that their sum is zero.
void push_apart(uvec4 at, IN(real3) of_y, IN(real3) of_z, IN(real3) of_w) {
  NEAR_ELSE(push_apart_near(at, of_y, of_z, of_w);)
  push_apart_far(at, of_y, of_z, of_w);
}

// Whether a contact gave an impulse in the first two rounds.
bool presses() {
  NEAR_ELSE(return near_presses != 0u;)
  return contact_list[0].presses != 0u;
}
void note_pressing() {
  NEAR_ELSE(near_presses = 1u;)
  ATOMIC_STORE(contact_list[0].presses, 1u);
}

// What contacts have noted so far.
struct Notes {
  uint unsettled_round;  // the latest one in which a contact had not settled
  uint bounces_from;     // the first one in which a contact that bounces gave an impulse
  uint bounce_round;     // the one in which impulses bounced
};

Notes all_notes() {
  Notes notes;
  NEAR_ELSE(notes.unsettled_round = near_unsettled_round; notes.bounces_from = near_bounces_from;
            notes.bounce_round = near_bounce_round;)
  {
    notes.unsettled_round = ATOMIC_LOAD(contact_list[0].unsettled_round);
    notes.bounces_from = ATOMIC_LOAD(contact_list[0].bounces_from);
    notes.bounce_round = ATOMIC_LOAD(contact_list[0].bounce_round);
  }
  return notes;
}
void note_unsettled(uint kick_round) {
  NEAR_ELSE(near_unsettled_round = kick_round;)
  ATOMIC_STORE(contact_list[0].unsettled_round, kick_round);
}
void note_bouncing(uint kick_round) {
  NEAR_ELSE(near_bounces_from = kick_round;)
  ATOMIC_STORE(contact_list[0].bounces_from, kick_round);
}
void note_bounce(uint kick_round) {
  NEAR_ELSE(near_bounce_round = kick_round;)
  ATOMIC_STORE(contact_list[0].bounce_round, kick_round);
}
