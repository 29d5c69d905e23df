// The test by T. Möller, "A fast triangle-triangle intersection test", Journal of Graphics Tools 2(2), 1997. It is as published, in
// fp32 with one absolute epsilon. It is kept for comparison with earlier work: it misses contacts of small triangles and reports others
// that are not there. certified_triangles.glsl has the test to use.
#ifndef MOLLER_TRIANGLES_GLSL
#define MOLLER_TRIANGLES_GLSL
#include "../language.glsl"
SHARED_BEGIN

// Returns the signed distances of the points to a triangle's plane, times the length of its normal. Small ones count as zero.
FN vec3 moller_plane_distances(IN(vec3) normal, IN(vec3) corner, IN_ARRAY(vec3, points, 3)) {
  float offset = -ordered_dot(normal, corner);
  EXACT vec3 distance = vec3(ordered_dot(normal, points[0]) + offset, ordered_dot(normal, points[1]) + offset,
                             ordered_dot(normal, points[2]) + offset);
  for (int i = 0; i < 3; ++i) {
    if (abs(distance[i]) < 1e-6f) distance[i] = 0.0f;
  }
  return distance;
}

FN bool moller_one_sided(IN(vec3) distance) { return distance.x * distance.y > 0.0f && distance.x * distance.z > 0.0f; }

// The corner that lies alone on its side of the other plane, or 3 if all lie in it.
FN int moller_lone_corner(IN(vec3) distance) {
  if (distance.x * distance.y > 0.0f) return 2;
  if (distance.x * distance.z > 0.0f) return 1;
  if (distance.y * distance.z > 0.0f || distance.x != 0.0f) return 0;
  if (distance.y != 0.0f) return 1;
  return distance.z != 0.0f ? 2 : 3;
}

// Returns where the planes' common line crosses the triangle, from x to y. `position` holds the corners' coordinates along the line.
FN vec2 moller_interval(IN(vec3) position, IN(vec3) distance, int lone) {
  int left = lone == 0 ? 1 : 0;
  int right = lone == 2 ? 1 : 2;
  EXACT float start = position[lone] + (position[left] - position[lone]) * distance[lone] / (distance[lone] - distance[left]);
  EXACT float end = position[lone] + (position[right] - position[lone]) * distance[lone] / (distance[lone] - distance[right]);
  return start < end ? vec2(start, end) : vec2(end, start);
}

// Twice the signed area of the triangle (a, b, c).
FN float moller_area(IN(vec2) a, IN(vec2) b, IN(vec2) c) {
  EXACT float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return area;
}

// Do the segments (a, b) and (c, d) cross? Parallel ones do not.
FN bool moller_edges_cross(IN(vec2) a, IN(vec2) b, IN(vec2) c, IN(vec2) d) {
  vec2 u = b - a, v = c - d, w = a - c;
  EXACT float f = u.y * v.x - u.x * v.y;
  EXACT float along_v = v.y * w.x - v.x * w.y;
  EXACT float along_u = u.x * w.y - u.y * w.x;
  bool positive = f > 0.0f && along_v >= 0.0f && along_v <= f && along_u >= 0.0f && along_u <= f;
  bool negative = f < 0.0f && along_v <= 0.0f && along_v >= f && along_u <= 0.0f && along_u >= f;
  return positive || negative;
}

FN bool moller_inside(IN(vec2) point, IN_ARRAY(vec2, corner, 3)) {
  float d0 = moller_area(corner[0], corner[1], point);
  float d1 = moller_area(corner[1], corner[2], point);
  float d2 = moller_area(corner[2], corner[0], point);
  return d0 * d1 > 0.0f && d0 * d2 > 0.0f;
}

FN int moller_longest(IN(vec3) v) {
  vec3 size = abs(v);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// Whether triangles in one plane touch. Drops the coordinate in which the normal is longest. Then tests edges against edges, and
// corners against areas.
FN bool moller_coplanar(IN(vec3) normal, IN_ARRAY(vec3, a, 3), IN_ARRAY(vec3, b, 3)) {
  int dropped = moller_longest(normal);
  int x = dropped == 0 ? 1 : 0;
  int y = dropped == 2 ? 1 : 2;
  vec2 p[3], q[3];
  for (int i = 0; i < 3; ++i) {
    p[i] = vec2(a[i][x], a[i][y]);
    q[i] = vec2(b[i][x], b[i][y]);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (moller_edges_cross(p[i], p[i < 2 ? i + 1 : 0], q[j], q[j < 2 ? j + 1 : 0])) return true;
    }
  }
  return moller_inside(p[0], q) || moller_inside(q[0], p);
}

// Whether triangles a and b touch [m, because of the absolute epsilon].
FN bool triangles_intersect_moller(IN_ARRAY(vec3, a, 3), IN_ARRAY(vec3, b, 3)) {
  vec3 normal_a = ordered_cross(a[1] - a[0], a[2] - a[0]);
  vec3 distance_b = moller_plane_distances(normal_a, a[0], b);
  if (moller_one_sided(distance_b)) return false;
  vec3 normal_b = ordered_cross(b[1] - b[0], b[2] - b[0]);
  vec3 distance_a = moller_plane_distances(normal_b, b[0], a);
  if (moller_one_sided(distance_a)) return false;

  int lone_a = moller_lone_corner(distance_a);
  int lone_b = moller_lone_corner(distance_b);
  if (lone_a == 3 || lone_b == 3) return moller_coplanar(normal_a, a, b);
  int along = moller_longest(ordered_cross(normal_a, normal_b));
  vec2 on_a = moller_interval(vec3(a[0][along], a[1][along], a[2][along]), distance_a, lone_a);
  vec2 on_b = moller_interval(vec3(b[0][along], b[1][along], b[2][along]), distance_b, lone_b);
  return !(on_a.y < on_b.x || on_b.y < on_a.x);
}

SHARED_END
#endif
