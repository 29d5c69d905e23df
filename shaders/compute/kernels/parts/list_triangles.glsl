// Lists the pairs of two leaves' triangles whose boxes of cages overlap. It takes every `stride`-th triangle of the first leaf, from
// `first` on. Pairs are counted beyond the list's end, too, which says that it is full. An island has no flight if the cage of one of its
// triangles overlaps that of a static one and meets its plane, or that of a scripted one.
READ(node)
READ(node_box)
READ(cage)
READ(triangle)
READ(rest_position)
READ(surface)
READ(start)
WRITE(contact_list)
WRITE(triangle_pair)
WRITE(cluster)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, has_rigid_bodies)
#include "node_boxes.glsl"
#include "boxes_in_motion.glsl"

dvec3 corner_at(uint t, uint k) { return LOAD3(start, start_position_of(triangle[corner_of(t, k)])); }

// Whether the cage of a triangle meets the plane of another one.
bool meets_plane(uint of_cage, uint of_plane) {
  PaddedBox cages = box_of_cages(of_cage);
  dvec3 lower = dvec3(vec3(cages.lower)), upper = dvec3(vec3(cages.upper)), corner = corner_at(of_plane, 0u);
  dvec3 normal = cross(corner_at(of_plane, 1u) - corner, corner_at(of_plane, 2u) - corner);
  return abs(dot(normal, double(0.5) * (lower + upper) - corner)) <= dot(abs(normal), double(0.5) * (upper - lower));
}

// The pairs are of s and of those triangles from t on that are set in `near`.
void end_flight_beside_rigid(uint s, uint t, uint near) {
  uint a = uint(rest_position[triangle[corner_of(s, 0u)]].w), b = uint(rest_position[triangle[corner_of(t, 0u)]].w);
  bool moves_a = surface[a].inverse_mass != double(0), moves_b = surface[b].inverse_mass != double(0);
  if (moves_a && moves_b) return;
  bool reaches = cluster[moves_a ? b : a].cannot_fly == 0u;  // scripted
  for (; near != 0u && !reaches; near &= near - 1u) {
    uint other = t + uint(findLSB(near));
    reaches = moves_a ? meets_plane(s, other) : meets_plane(other, s);
  }
  if (reaches) ATOMIC_STORE(cluster[cluster[moves_a ? a : b].island].is_beside_static, 1u);
}

// Lists pairs of s with those of up to 32 triangles from t on that are set in `near`.
void list_pairs(uint s, uint t, uint near, uint meeting) {
  if (ATOMIC_LOAD(contact_list[0].triangle_pair_count) > triangle_pair_capacity) return;  // the count could pass 2^32
  APPEND_EACH(k, near, triangle_pair, contact_list[0].triangle_pair_count, triangle_pair_capacity,
              uvec2(s, (t + k) | ((meeting >> k & 1u) != 0u ? ways_meet : 0u)))
}

// Returns those triangles from t on that are set in `among` and whose cages, or expected ways, overlap a box.
uint overlapping(IN(PaddedBox) box, uint t, uint among, bool by_ways) {
  uint near = 0u;
  for (; among != 0u; among &= among - 1u) {
    uint k = uint(findLSB(among));
    if (overlaps(box, by_ways ? box_of_ways(t + k) : box_of_cages(t + k))) near |= 1u << k;
  }
  return near;
}

// Those of 32 triangles from t on that stand behind s: each two of a leaf meet once.
uint behind(uint s, uint t) { return s < t ? ~0u : s - t >= 31u ? 0u : ~0u << (s - t + 1u); }

// The leaves' boxes leave out most triangles before they are compared with each other.
void list_triangles(uvec2 leaves, uint first, uint stride) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  PaddedBox of_first = box_of_node(leaves.x), of_second = box_of_node(leaves.y);
  for (uint t = b.z; t < b.w; t += 32u) {
    uint among = overlapping(of_first, t, 0xffffffffu >> (32u - min(b.w - t, 32u)), false);
    if (among == 0u) continue;
    for (uint s = a.z + first; s < a.w; s += stride) {
      PaddedBox cages = box_of_cages(s);
      if (!overlaps(cages, of_second)) continue;
      uint near = overlapping(cages, t, among, false);
      if (leaves.x == leaves.y) near &= behind(s, t);
      if (near == 0u) continue;
      list_pairs(s, t, near, overlapping(box_of_ways(s), t, near, true));
      if (has_rigid_bodies != 0u) end_flight_beside_rigid(s, t, near);
    }
  }
}
