// A body's rigid motion in the half of `motion` that moments_half() names, by its parts. A thread sums up each part, and then any thread
// can ask for the body's rigid motion.
uint vertex_at(uint i) { return in_half(moments_half(), vertex_count, i); }
dvec3 place_of(uint i) { return dvec3(vec3(rest_position[i])) + LOAD3(motion, displacement_of(vertex_at(i))); }
dvec3 velocity_of_vertex(uint i) { return LOAD3(motion, velocity_of(vertex_at(i))); }

void sum_moments_of(uvec4 part, uint item) {
  dvec3 origin = place_of(body[part.x].first_vertex);
  Moments sum = no_moments();
  for (uint i = part.y; i < part.z; ++i) add_vertex(sum, place_of(i) - origin, velocity_of_vertex(i));
  part_sum[item].moments = sum;
}

Moments moments_of_body(uint b) {
  uvec2 range = vertex_part_range[b];
  Moments sum = no_moments();
  for (uint k = range.x; k < range.x + range.y; ++k) {
    Moments more = part_sum[k].moments;  // NVIDIA's compiler takes no shared element as an argument
    add_moments(sum, more);
  }
  return sum;
}

RigidMotion rigid_motion_of_body(uint b) {
  return rigid_motion_with(moments_of_body(b), double(body[b].vertex_count), place_of(body[b].first_vertex), dvec3(0));
}
