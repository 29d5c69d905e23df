// Sums of impulses, in quanta. Rounds of a kick take turns in three buffers: one is read, one added to, and one cleared.
uint buffer_of(uint rounds) { return rounds % sum_buffers; }

// Clears the sums of a vertex. All of its contacts may do so.
void clear_impulse(uint at) {
  for (uint k = 0u; k < 3u; ++k) {
    CLEAR_SUM(impulse_sum[at + k])
  }
}
