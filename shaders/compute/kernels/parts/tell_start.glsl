// Tells the work groups of a body what they share at the start of quiet steps: how its first vertex moves, and the reference.
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
void tell_start(uint b) {
  uint first = displacement_of(in_half(from_half, vertex_count, body[b].first_vertex));
  for (uint k = 0u; k < motion_size; ++k) quiet_body[b].first_motion[motion_size * from_half + k] = motion[first + k];
  for (uint k = 0u; k < 3u; ++k) quiet_body[b].reference[3u * from_half + k] = pose[b].reference[k];
}
