// The frame around kernels whose items are served by a group of threads each. All threads of a group call the kernel's function for its
// item. They have to MEET equally often.
#version 450
#include "subgroups.glsl"
#include "physics/language.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "@kernel"
#include "turns.glsl"
PARAMETER(uint, item_count)
void main() {
  uint turn = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;  // dispatches past max_groups have several rows
  if (turn < item_count) KERNEL(item_at(turn, item_count));
}
