// One thread serves one vertex, if a tolerance governs steps. It extends the box of the ways that touching vertices went in this step.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/pace.glsl"
WRITE(pace)
READ(control)
READ(pose)
READ(rest_position)
READ(mark)
READ(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)

uint ordered(double coordinate) { return ordered_bits(float(coordinate)); }

void measure_contact(uint i) {
  if (mark[i] != control[0].step) return;
  uint before = displacement_of(in_half(from_half, vertex_count, i));
  uint after = displacement_of(in_half(other_half(from_half), vertex_count, i));
  dvec3 way = rotate(pose[uint(rest_position[i].w)], LOAD3(motion, after) - LOAD3(motion, before));
  atomicMin(pace[0].least_x, ordered(way.x));
  atomicMin(pace[0].least_y, ordered(way.y));
  atomicMin(pace[0].least_z, ordered(way.z));
  atomicMax(pace[0].most_x, ordered(way.x));
  atomicMax(pace[0].most_y, ordered(way.y));
  atomicMax(pace[0].most_z, ordered(way.z));
}
