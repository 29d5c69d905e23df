// Do two triangles touch? "No" is a proof: on some axis their shadows are further apart than rounding can account for.
// A pair too close to tell (about 1e-6 of its size) counts as touching. Axes may be rounded freely. Only the shadows' error has to be
// bounded. The separating axis test is from S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996.
#ifndef CERTIFIED_TRIANGLES_GLSL
#define CERTIFIED_TRIANGLES_GLSL
#include "../language.glsl"
SHARED_BEGIN

FN int next_corner(int corner) { return corner == 2 ? 0 : corner + 1; }

// Returns how far apart two shadows on the axis have to be so that rounding cannot account for it. `reach` holds the largest
// |coordinate| of the points in x, y and z. Coordinates are below 2.
//
// Let e = 2^-23, the relative error of one operation whichever way it rounds, and S = sum |d_k| reach_k.
// - A point's coordinate has one rounding, that of its difference. Its shadow (dx px + dy py) + dz pz has three more. A shadow
//   therefore errs by at most 4 e S, and the two that bound a gap by 8 e S.
// - The ninth e S pays for the gap's subtraction and for S's own roundings. They are of the order e^2 S and e times the gap.
// - Numbers below 1.2e-38 may be flushed to zero. This changes a coordinate by at most 4e-38 * 2^64 = 7e-19 (see
//   triangles_may_touch), and two shadows by 1.4e-18 sum |d_k|. The 1e-9 in reach covers it (9 e * 1e-9 = 1e-15). It changes the
//   products and sums here by at most 24 * 2.4e-38, which the 1e-30 covers.
FN float shadow_error(IN(vec3) axis, IN(vec3) reach) {
  EXACT float bound = 9.0f / 8388608.0f * ordered_dot(abs(axis), reach) + 1e-30f;
  return bound;
}

// Are the shadows of points 0 to 2 and of points 3 to 5 certainly apart?
FN bool certainly_apart(IN(vec3) axis, IN_ARRAY(vec3, p, 6), IN(vec3) reach) {
  float a0 = ordered_dot(axis, p[0]), a1 = ordered_dot(axis, p[1]), a2 = ordered_dot(axis, p[2]);
  float b0 = ordered_dot(axis, p[3]), b1 = ordered_dot(axis, p[4]), b2 = ordered_dot(axis, p[5]);
  EXACT float gap = max(min(min(b0, b1), b2) - max(max(a0, a1), a2), min(min(a0, a1), a2) - max(max(b0, b1), b2));
  return gap > shadow_error(axis, reach);
}

// Compares the shadows of the other three points with those of the points first, first + 1 and first + 2. Returns 1 for a point
// whose shadow is certainly above all those, -1 if it is certainly below, 0 if neither.
FN vec3 certain_sides(IN(vec3) axis, IN_ARRAY(vec3, p, 6), int first, IN(vec3) reach) {
  float s0 = ordered_dot(axis, p[first]), s1 = ordered_dot(axis, p[first + 1]), s2 = ordered_dot(axis, p[first + 2]);
  float low = min(min(s0, s1), s2), high = max(max(s0, s1), s2);
  float bound = shadow_error(axis, reach);
  vec3 sides = vec3(0.0f);
  for (int i = 0; i < 3; ++i) {
    float shadow = ordered_dot(axis, p[3 - first + i]);
    EXACT float above = shadow - high;
    EXACT float below = low - shadow;
    sides[i] = above > bound ? 1.0f : (below > bound ? -1.0f : 0.0f);
  }
  return sides;
}

FN bool same_side(float a, float b) { return a * b > 0.0f; }
FN bool one_sided(IN(vec3) sides) { return same_side(sides.x, sides.y) && same_side(sides.y, sides.z); }
FN bool all_certain(IN(vec3) sides) { return sides.x * sides.y * sides.z != 0.0f; }

// Returns false only if the closed triangles a and b [any unit] have no point in common. Returns true for NaN, infinities, and pairs
// smaller than 1e-19 or larger than 1e30. The answer may depend on the order of vertices only for pairs too close to tell.
FN bool triangles_may_touch(IN_ARRAY(vec3, a, 3), IN_ARRAY(vec3, b, 3)) {
  EXACT vec3 p[6];  // relative to a[0], so that an offset costs no digits
  EXACT vec3 total = vec3(0.0f);
  for (int i = 0; i < 3; ++i) {
    p[i] = a[i] - a[0];
    p[i + 3] = b[i] - a[0];
    total = total + (abs(p[i]) + abs(p[i + 3]));
  }
  EXACT float size = (total.x + total.y) + total.z;
  if (!(size > 1e-19f && size < 1e30f)) return true;  // also for NaN

  // A power of two between 2^-100 and 2^64 scales the points exactly, so that size lies between 1 and 2.
  float scale = uintBitsToFloat(0x7f000000u - (floatBitsToUint(size) & 0x7f800000u));
  vec3 reach = vec3(0.0f);
  for (int i = 0; i < 6; ++i) {
    p[i] = p[i] * scale;
    reach = max(reach, abs(p[i]));
  }
  reach = reach + vec3(1e-9f);

  EXACT vec3 edge[6];
  for (int i = 0; i < 3; ++i) {
    edge[i] = (a[next_corner(i)] - a[i]) * scale;
    edge[i + 3] = (b[next_corner(i)] - b[i]) * scale;
  }

  vec3 sides_b = certain_sides(ordered_cross(edge[0], edge[1]), p, 0, reach);
  if (one_sided(sides_b)) return false;
  vec3 sides_a = certain_sides(ordered_cross(edge[3], edge[4]), p, 3, reach);
  if (one_sided(sides_a)) return false;

  // Each triangle covers a stretch of the line that both planes share. The stretches end on edges that cross the other plane. If
  // the stretches are apart, two of their ends face each other. A plane that holds the directions of both ends' edges then parts
  // the triangles.
  for (int i = 0; i < 3; ++i) {
    if (same_side(sides_a[i], sides_a[next_corner(i)])) continue;
    for (int j = 0; j < 3; ++j) {
      if (same_side(sides_b[j], sides_b[next_corner(j)])) continue;
      if (certainly_apart(ordered_cross(edge[i], edge[j + 3]), p, reach)) return false;
    }
  }
  if (all_certain(sides_a) && all_certain(sides_b)) return true;

  // Coplanar triangles part along a normal of an edge in their plane. Triangles without area may part along the line between their
  // centres. That line never runs along an edge whose normal parts the triangles, because the centres lie on the edge's two sides.
  EXACT vec3 between = ((p[3] + p[4]) + p[5]) - ((p[0] + p[1]) + p[2]);
  if (certainly_apart(between, p, reach)) return false;
  for (int i = 0; i < 6; ++i) {
    if (certainly_apart(ordered_cross(ordered_cross(edge[i], between), edge[i]), p, reach)) return false;
  }
  return true;
}

SHARED_END
#endif
