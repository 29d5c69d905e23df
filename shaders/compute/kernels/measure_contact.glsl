// One thread a vertex, where a tolerance governs steps: extends the box of the ways that touching vertices went in this step.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/pace.glsl"
WRITE(0, Paces, Pace, pace)
READ(1, Controls, Control, control)
READ(2, Frames, Frame, frame)
READ(3, RestPositions, vec4, rest_position)
READ(4, Marks, uint, mark)
READ(5, Motions, double, motion)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)

uint ordered(double coordinate) { return ordered_bits(float(coordinate)); }

void measure_contact(uint i) {
  if (mark[i] != control[0].step) return;
  uint before = 6u * (from_half * vertex_count + i), after = 6u * ((1u - from_half) * vertex_count + i);
  dvec3 way = rotate(frame[uint(rest_position[i].w)], LOAD3(motion, after) - LOAD3(motion, before));
  atomicMin(pace[0].least_x, ordered(way.x));
  atomicMin(pace[0].least_y, ordered(way.y));
  atomicMin(pace[0].least_z, ordered(way.z));
  atomicMax(pace[0].most_x, ordered(way.x));
  atomicMax(pace[0].most_y, ordered(way.y));
  atomicMax(pace[0].most_z, ordered(way.z));
}
