// The frame around every kernel but force kernels (force.comp), kernels in rounds (rounds.comp) and group kernels (groups.comp). It includes
// the kernel's file by name. One thread calls the kernel's function for one item.
#version 450
#include "subgroups.glsl"
#include "physics/language.glsl"
#include "@kernel"
#include "turns.glsl"
layout(local_size_x = 64) in;
PARAMETER(uint, item_count)
void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;  // dispatches past max_groups have several rows
  uint turn = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (turn < item_count) KERNEL(item_at(turn, item_count));
}
