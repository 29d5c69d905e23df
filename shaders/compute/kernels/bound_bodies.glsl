// One thread a vertex: each body's box, and the first vertex whose position or velocity is not a finite number.
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
WRITE(0, Controls, Control, control)
READ(1, RestPositions, vec4, rest_position)
READ(2, Motions, double, motion)
READ(3, WorldPositions, vec4, world_position)
WRITE(4, BodyBoxes, uint, body_box)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, half_index)

bool finite3(vec3 v) { return abs(v.x) <= 3.0e38f && abs(v.y) <= 3.0e38f && abs(v.z) <= 3.0e38f; }

void bound_bodies(uint i) {
  if (control[0].non_finite_step != 0u) return;
  uint at = half_index * vertex_count + i;
  vec3 p = vec3(world_position[at]);
  if (!finite3(p) || !finite3(vec3(LOAD3(motion, 6u * at + 3u)))) {
    atomicMin(control[0].non_finite_vertex, i);
    return;
  }
  uint first = 6u * uint(rest_position[i].w);
  atomicMin(body_box[first], ordered_bits(p.x));
  atomicMin(body_box[first + 1u], ordered_bits(p.y));
  atomicMin(body_box[first + 2u], ordered_bits(p.z));
  atomicMax(body_box[first + 3u], ordered_bits(p.x));
  atomicMax(body_box[first + 4u], ordered_bits(p.y));
  atomicMax(body_box[first + 5u], ordered_bits(p.z));
}
