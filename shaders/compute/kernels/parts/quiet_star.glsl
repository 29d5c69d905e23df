// Proves in a quiet step that a body that meets itself stays a star (physics/contact/star.glsl). It is looked at from the centroid of its
// rest shape, which goes along with its first vertex. Other steps look from elsewhere, at what they expect. The proof asks for more than
// they do, so that they would hardly ever find another answer.
#include "../../physics/contact/star.glsl"
READ(triangle)
PARAMETER(uint, watches_stars)  // 1: bodies may meet themselves

const real least_quiet_depth = real(1);        // of the centroid below each triangle, in edges
const real most_change_of_edge = real(0.125);  // in edges

// Relative to the centroid, in the body's frame [m].
real3 quiet_place(IN(Share) s, uint i, uint half_index) {
  uint at = in_half(half_index, vertex_count, i), first = in_half(half_index, vertex_count, s.body.first_vertex);
  return real3(dvec3(vec3(rest_position[i])) + (LOAD3(motion, displacement_of(at)) - LOAD3(motion, displacement_of(first))));
}

bool keeps_edges(IN(Facet) f, real most) {
  bool keeps = true;
  for (int k = 0; k < 3; ++k) {
    int next = k == 2 ? 0 : k + 1;
    keeps = keeps && length((f.end[next] - f.end[k]) - (f.start[next] - f.start[k])) <= most;
  }
  return keeps;
}

bool stays_star(uint t, IN(Share) s, IN(QuietStar) star) {
  Facet f;
  for (uint k = 0u; k < 3u; ++k) {
    uint i = triangle[corner_of(t, k)];
    f.start[k] = quiet_place(s, i, from_half);
    f.end[k] = quiet_place(s, i, other_half(from_half));
  }
  real winding = real(star.winding), edge = real(star.edge), depth = least_quiet_depth * edge;
  return keeps_edges(f, most_change_of_edge * edge) && faces_out(f, winding, real(star.rounding)) &&
         is_deep_below(f.start[0], f.start[1], f.start[2], winding, depth) &&
         is_deep_below(f.end[0], f.end[1], f.end[2], winding, depth);
}

// After all groups have met, those of a body share its triangles out. A step that is not proven does not stand.
void prove_star(Share s) {
  QuietStar star = quiet_body[s.body_index].star;
  uint groups = groups_of(s), group = (s.first_vertex - s.body.first_vertex) / (VERTICES * TEAMS);
  for (uint t = star.first_triangle + group + groups * gl_LocalInvocationID.x; t < star.end_triangle; t += groups * gl_WorkGroupSize.x) {
    if (stays_star(t, s, star)) continue;
    status[s.body_index].steps_to_star = steps_after_no_star;
    take_back_step();
  }
}
