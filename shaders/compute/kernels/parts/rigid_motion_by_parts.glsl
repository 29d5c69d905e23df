// A body's rigid motion in the half of `motion` that moments_half() names, by its parts. A thread sums up each part. In two rounds more sums
// of parts are added up. Then any thread can ask for the body's rigid motion.
uint vertex_at(uint i) { return in_half(moments_half(), vertex_count, i); }
dvec3 place_of(uint i) { return dvec3(vec3(rest_position[i])) + LOAD3(motion, displacement_of(vertex_at(i))); }
dvec3 velocity_of_vertex(uint i) { return LOAD3(motion, velocity_of(vertex_at(i))); }

void sum_moments_of(uvec4 part, uint item) {
  dvec3 origin = place_of(body[part.x].first_vertex);
  Moments sum = no_moments();
  for (uint i = part.y; i < part.z; ++i) add_vertex(sum, place_of(i) - origin, velocity_of_vertex(i));
  part_sum[item].moments = sum;
}

// Parts are added up in two rounds, those of a block to its first one, and then blocks to the body's first part.
struct PartsToAdd {
  uint from, end, step;
};
PartsToAdd parts_to_add(uvec4 part, uint item, bool are_blocks) {
  uvec2 range = vertex_part_range[part.x];
  uint reach = are_blocks ? range.y : part.w;
  PartsToAdd parts;
  parts.step = are_blocks ? part.w : 1u;
  parts.from = item + parts.step;
  parts.end = (item - range.x) % reach == 0u ? min(item + reach, range.x + range.y) : 0u;
  return parts;
}

void add_up_moments(uvec4 part, uint item, bool are_blocks) {
  PartsToAdd parts = parts_to_add(part, item, are_blocks);
  if (parts.from >= parts.end) return;
  Moments sum = part_sum[item].moments;
  for (uint k = parts.from; k < parts.end; k += parts.step) {
    Moments more = part_sum[k].moments;  // NVIDIA's compiler takes no shared element as an argument
    add_moments(sum, more);
  }
  part_sum[item].moments = sum;
}

// Sums of a body stand in its first part once they have been added up.
uint sums_of_body(uint b) { return vertex_part_range[b].x; }
bool has_sums(uint b) { return vertex_part_range[b].y != 0u; }

Moments moments_of_body(uint b) {
  Moments sum = no_moments();
  if (has_sums(b)) sum = part_sum[sums_of_body(b)].moments;
  return sum;
}

RigidMotion rigid_motion_of_body(uint b) {
  return rigid_motion_with(moments_of_body(b), double(body[b].vertex_count), place_of(body[b].first_vertex), dvec3(0));
}
