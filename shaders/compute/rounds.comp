// The frame around kernels that go in rounds. One thread calls the kernel's function for one item in one round. The next round begins when
// all threads have ended theirs. Work groups wait for each other, so no more of them are started than certainly run side by side. Only as
// many take part as there are items for.
// What items_in_a_round() reads must not change in the first round, and what goes_on(n) answers must not change once round n has ended:
// else a slow group would leave alone. On an H200 64 threads a group were faster than more: rounds wait for memory, not for arithmetic.
#version 450
#include "physics/language.glsl"
#include "@kernel"
layout(local_size_x = 64) in;
PARAMETER(uint, item_count)  // work groups

const uint most_polls_of_a_round = 1u << 22;  // which take some seconds

// Waits until all groups have come here `often` times.
void wait_for_others(uint groups, uint often) {
  memoryBarrierBuffer();
  barrier();
  if (groups == 1u) return;
  if (gl_LocalInvocationID.x == 0u) {
    uint polls = 0u;
    atomicAdd(contact_list[0].arrivals, 1u);
    while (atomicAdd(contact_list[0].arrivals, 0u) < groups * often && polls < most_polls_of_a_round) ++polls;
    if (polls == most_polls_of_a_round) atomicOr(contact_list[0].arrivals, waited_in_vain);  // the others need not wait, either
    memoryBarrierBuffer();
  }
  barrier();
}

void main() {
  uint count = items_in_a_round();
  if (count == 0u) return;
  uint groups = min((count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x, item_count);
  if (gl_WorkGroupID.x < groups) {
    for (uint number = 0u; number < rounds_at_most(); ++number) {
      for (uint item = gl_GlobalInvocationID.x; item < count; item += groups * gl_WorkGroupSize.x) KERNEL(item, number);
      wait_for_others(groups, number + 1u);
      if (!goes_on(number)) break;
    }
  }
}
