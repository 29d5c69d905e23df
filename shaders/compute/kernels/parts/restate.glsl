// Restates the motion of both halves and the placement in a frame that has turned.
#include "frame_change.glsl"
dvec3 turned(uint b, dvec3 p) {
  return dvec3(row_times(CHANGE_OF(b).turn[0], CHANGE_OF(b).turn[1], CHANGE_OF(b).turn[2], p),
               row_times(CHANGE_OF(b).turn[3], CHANGE_OF(b).turn[4], CHANGE_OF(b).turn[5], p),
               row_times(CHANGE_OF(b).turn[6], CHANGE_OF(b).turn[7], CHANGE_OF(b).turn[8], p));
}

void restate(uint i, uint b, double inverse_unit) {
  dvec3 rest = dvec3(vec3(rest_position[i]));
  for (uint half_index = 0u; half_index < 2u; ++half_index) {
    uint at = in_half(half_index, vertex_count, i), u = displacement_of(at), w = velocity_of(at);
    dvec3 displacement = turned(b, rest + LOAD3(motion, u)) - rest - LOAD3(CHANGE_OF(b).shift, 0u);
    dvec3 velocity = turned(b, LOAD3(motion, w));
    STORE3(motion, u, displacement)
    STORE3(motion, w, velocity)
    if (half_index == from_half) continue;
    dvec3 relative = displacement - LOAD3(pose[b].reference, 0u);
    for (uint k = 0u; k < 3u; ++k) place(start_slot, i, k, inverse_unit, rest[int(k)], relative[int(k)]);
  }
}
