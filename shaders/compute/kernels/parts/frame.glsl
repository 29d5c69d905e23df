// What a step knows of a body from its start, on axis k.
double gravity_of(uint b, uint k) { return pose[b].gravity[k]; }
double origin_of(uint b, uint k) { return pose[b].origin[k]; }

// The motion of the body's first vertex, which placements are relative to.
double first_displacement(uint first_vertex, uint k) { return motion[displacement_of(in_half(from_half, vertex_count, first_vertex)) + k]; }
double first_velocity(uint first_vertex, uint k) { return motion[velocity_of(in_half(from_half, vertex_count, first_vertex)) + k]; }

// A vector of the body's frame in the world.
double in_world(uint b, uint k, dvec3 p) {
  return row_times(pose[b].rotation[3u * k], pose[b].rotation[3u * k + 1u], pose[b].rotation[3u * k + 2u], p);
}
