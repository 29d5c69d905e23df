// Where vertex i is at a stage, as placed [body's unit], and its velocity in the body's frame [m/s]. A method with stages keeps the
// velocities of later stages in `acceleration`.
dvec3 place_at_stage(uint i) { return dvec3(real3(placed[position_at(slot, vertex_count, i)])); }
dvec3 velocity_at_stage(uint i) {
  if (stage_index > 0u) return LOAD3(acceleration, acceleration_of(stage_index, vertex_count, i));
  return LOAD3(motion, velocity_of(in_half(half_index, vertex_count, i)));
}
