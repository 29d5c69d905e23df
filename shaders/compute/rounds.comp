// The frame around kernels that go in rounds. One thread calls the kernel's function for one item in one round. The next round begins when
// all threads have ended theirs. Work groups wait for each other, so no more of them are started than there are multiprocessors. Only as
// many take part as there are items for.
// - What items_in_a_round() reads must not change in the first round.
// - After round n each thread asks goes_on(n) once, whether there is another round. The answer must not change once round n has ended: else
//   a slow group would leave alone.
// - goes_on() may look up what its thread needs in the next round. A kernel can count on that only if has_own_thread is true. On the CPU it
//   never is.
//
// A group has 128 threads, because 64 took longer. Of a kernel that takes much memory a GPU runs fewer groups at once. In a rehearsal groups do
// nothing but wait for each other, by which a device finds how many of them run at once.
//
// A kernel may define SIEVES. needs_more(k, item, round) has an item go through sieve k, and returns whether it needs the next one. Such
// items wait in shared memory. When as many wait as the group has threads, each thread takes one. So no thread idles beside one that has
// more to do. The kernel's function, with all sieves in turn, is then for the CPU alone, and nothing can count on has_own_thread.
//
// A kernel may define NEAR_ROUNDS, and with it GROUP_SIZE and far_threads:
// - One group serves up to near_items items. begin_near() then sets sums_are_near if threads share only the group's own memory, in all
//   rounds but the last.
// - Several groups share more items out. Each has as many threads as it takes to give every item its own, from far_threads to GROUP_SIZE. A
//   thread of several items would have to load them anew in each round.
#version 450
#include "subgroups.glsl"
#extension GL_ARB_gpu_shader_int64 : enable
#extension GL_NV_gpu_shader5 : enable
#extension GL_NV_shader_atomic_int64 : enable
#ifdef GL_NV_shader_atomic_int64
#define ADDS_64_BITS
#endif
#include "physics/language.glsl"
#include "physics/body.glsl"
bool has_own_thread = false;  // whether an item has a thread to itself in all rounds
#include "@kernel"
#include "turns.glsl"
#ifndef NEAR_ROUNDS
#define GROUP_SIZE 128u
const uint far_threads = GROUP_SIZE;
#endif
layout(local_size_x = GROUP_SIZE) in;
PARAMETER(uint, item_count)  // work groups
layout(location = 1000) uniform uint is_rehearsal;  // behind those of all parameters
#include "kernels/parts/was_stopped.glsl"

// Waits until all groups have come here `often` times.
void wait_for_others(uint groups, uint often) {
  memoryBarrierBuffer();
  barrier();
  if (groups == 1u) return;
  if (gl_LocalInvocationID.x == 0u) {
    uint polls = 0u, most = is_rehearsal != 0u ? most_polls_of_rehearsal : most_polls;
    atomicAdd(contact_list[0].arrivals, 1u);
    while (atomicAdd(contact_list[0].arrivals, 0u) < groups * often && polls < most) ++polls;
    if (polls == most) atomicOr(contact_list[0].arrivals, waited_in_vain);  // the others need not wait, either
    memoryBarrierBuffer();
  }
  barrier();
}

// The last group to leave counts from 0 again, for the next kernel that goes in rounds.
void leave(uint groups, uint waits) {
  if (groups == 1u || gl_LocalInvocationID.x != 0u) return;
  uint before = atomicAdd(contact_list[0].arrivals, 1u) & ~waited_in_vain;
  if (before + 1u == groups * (waits + 1u)) atomicAnd(contact_list[0].arrivals, waited_in_vain);
}

void end_round(uint groups, uint number) {
#ifdef NEAR_ROUNDS
  if (sums_are_near) {
    end_near_round(number);
    return;
  }
#endif
  wait_for_others(groups, number + 1u);
}

// Of a group where several share the items.
uint threads_of_a_group(uint count) {
  uint for_one_item = (count + item_count - 1u) / item_count;
  return clamp((for_one_item + 31u) / 32u * 32u, far_threads, GROUP_SIZE);
}

#ifdef SIEVES
#ifdef NEAR_ROUNDS
#error an item of several sieves goes from thread to thread
#endif
// Fewer than GROUP_SIZE wait for sieve k + 1 when a group takes items anew. Until they are taken, (k + 1) GROUP_SIZE more may come.
const uint waiting_room = SIEVES * GROUP_SIZE;
shared uint waiting[(SIEVES - 1u) * waiting_room];
shared uint waiting_count[SIEVES - 1u];

void pass_through(uint sieve, uint item, uint number) {
  if (!needs_more(sieve, item, number) || sieve + 1u == SIEVES) return;
  waiting[sieve * waiting_room + atomicAdd(waiting_count[sieve], 1u)] = item;
}

// Each thread has an item, but for those whose turn is past the end.
void pass_all_through(uint turn, uint count, bool no_more_come, uint number) {
  uint thread = gl_LocalInvocationID.x;
  barrier();  // behind what emptied the lists, and what read the last one
  if (turn < count) pass_through(0u, item_at(turn, count), number);
  for (uint sieve = 1u; sieve < SIEVES; ++sieve) {
    barrier();
    uint left = waiting_count[sieve - 1u];
    barrier();
    while (left >= GROUP_SIZE || (no_more_come && left > 0u)) {
      uint taken = min(left, GROUP_SIZE);
      left -= taken;
      if (thread < taken) pass_through(sieve, waiting[(sieve - 1u) * waiting_room + left + thread], number);
    }
    if (thread == 0u) waiting_count[sieve - 1u] = left;
  }
}

void run_round(uint groups, uint threads, uint count, uint number) {
  if (gl_LocalInvocationID.x < SIEVES - 1u) waiting_count[gl_LocalInvocationID.x] = 0u;
  for (uint first = gl_WorkGroupID.x * threads; first < count; first += groups * threads)
    pass_all_through(first + gl_LocalInvocationID.x, count, first + groups * threads >= count, number);
}
#else
void run_round(uint groups, uint threads, uint count, uint number) {
  if (gl_LocalInvocationID.x >= threads) return;
  for (uint turn = gl_WorkGroupID.x * threads + gl_LocalInvocationID.x; turn < count; turn += groups * threads)
    KERNEL(item_at(turn, count), number);
}
#endif

void main() {
  if (is_rehearsal != 0u) {
    wait_for_others(item_count, 1u);
    leave(item_count, 1u);
    return;
  }
  uint count = items_in_a_round();
  if (count == 0u) return;
  uint threads = threads_of_a_group(count), groups = min((count + threads - 1u) / threads, item_count);
#ifdef NEAR_ROUNDS
  if (count <= near_items || item_count == 1u) {
    threads = GROUP_SIZE;
    groups = 1u;
  }
#endif
  if (gl_WorkGroupID.x >= groups) return;
#ifdef NEAR_ROUNDS
  if (count <= near_items) begin_near(count);
#endif
  has_own_thread = count <= groups * threads;
  uint number = 0u;
  bool more = true;
  while (more) {
    run_round(groups, threads, count, number);
    end_round(groups, number);
    more = goes_on(number) && number + 1u < rounds_at_most();
    ++number;
  }
  if (was_stopped(count)) atomicOr(contact_list[0].arrivals, waited_in_vain);
  leave(groups, number);
}
