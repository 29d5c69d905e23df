// Sums of impulses, in quanta. Rounds of a kick take turns in three buffers: one is read, one added to, and one cleared.
#include "quantum.glsl"

uint buffer_of(uint rounds) { return rounds % sum_buffers; }

dvec3 impulse_on(uint buffer_index, uint i) {
  uint at = impulse_sum_of(buffer_index, vertex_count, i);
  return dvec3(whole_of(impulse_sum[at]), whole_of(impulse_sum[at + 1u]), whole_of(impulse_sum[at + 2u]));
}

// Every contact of the vertex may clear it.
void clear_impulse(uint buffer_index, uint i) {
  uint at = impulse_sum_of(buffer_index, vertex_count, i);
  for (uint k = 0u; k < 3u; ++k) {
    ATOMIC_STORE(impulse_sum[at + k].x, 0u);
    ATOMIC_STORE(impulse_sum[at + k].y, 0u);
  }
}
