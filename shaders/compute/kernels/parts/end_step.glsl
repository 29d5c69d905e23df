// Ends the step of vertex i on axis k. Writes its displacement [m] and velocity [m/s] in the body's frame. `reference` is the
// displacement that the next placement is relative to [m].
void end_step(uint i, uint k, IN(Share) s, double displacement, double velocity, double reference) {
  uint after = in_half(other_half(from_half), vertex_count, i);
  motion[displacement_of(after) + k] = displacement;
  motion[velocity_of(after) + k] = velocity;
  if (!is_finite(float(velocity))) note_non_finite(s.body_index, i);
  if (i == s.body.first_vertex) tell_reference(s.body_index, k, reference);
}

// Writes the world position on axis k, rounded once, of a vertex that stands at `position` in the body's frame [m].
void end_in_world(uint i, uint k, uint b, dvec3 position) {
  double turned = in_world(b, k, position);
  EXACT double coordinate = turned + origin_of(b, k);
  uint after = in_half(other_half(from_half), vertex_count, i);
  world_coordinate[number_of(after, k)] = float(coordinate);
  bound(i, b, k, float(coordinate));
}
