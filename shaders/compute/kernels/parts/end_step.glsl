// Writes the step's end: displacement and velocity in the body's frame, and the world position, rounded once.
void end_step(uint i, uint b, dvec3 displacement, dvec3 velocity) {
  uint after = (1u - from_half) * vertex_count + i;
  STORE3(motion, 6u * after, displacement)
  STORE3(motion, 6u * after + 3u, velocity)
  world_position[after] = vec4(vec3(to_world(frame[b], dvec3(vec3(rest_position[i])) + displacement)), 1);
}
