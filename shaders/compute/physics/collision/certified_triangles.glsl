// Do two triangles touch? "No" is a proof: on some axis their shadows are further apart than rounding can account for.
// A pair too close to tell (about 1e-6 of its size) counts as touching. Axes may be rounded freely. Only the shadows' error has to be
// bounded. The separating axis test is from S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996.
// device/cpu/triangle_lanes.inc makes the operations up to all_certain() in vectors: change both.
#ifndef CERTIFIED_TRIANGLES_GLSL
#define CERTIFIED_TRIANGLES_GLSL
#include "../language.glsl"
SHARED_BEGIN

// Three points or three edges side by side: number k in component k of each vector, and the first one again in w.
struct Three { vec4 x; vec4 y; vec4 z; };

FN Three three_of(IN(vec4) x, IN(vec4) y, IN(vec4) z) {
  Three all;
  all.x = x;
  all.y = y;
  all.z = z;
  return all;
}

FN Three three(IN(vec3) p, IN(vec3) q, IN(vec3) r) {
  Three all;
  all.x = vec4(p.x, q.x, r.x, p.x);
  all.y = vec4(p.y, q.y, r.y, p.y);
  all.z = vec4(p.z, q.z, r.z, p.z);
  return all;
}

FN Three less(IN(Three) all, IN(vec3) p) {
  EXACT vec4 x = all.x - vec4(p.x);
  EXACT vec4 y = all.y - vec4(p.y);
  EXACT vec4 z = all.z - vec4(p.z);
  return three_of(x, y, z);
}

FN Three scaled(IN(Three) all, float scale) {
  EXACT vec4 x = all.x * scale;
  EXACT vec4 y = all.y * scale;
  EXACT vec4 z = all.z * scale;
  return three_of(x, y, z);
}

// From each corner to the next.
FN Three edges_of(IN_ARRAY(vec3, corner, 3)) {
  Three from = three(corner[0], corner[1], corner[2]), to = three(corner[1], corner[2], corner[0]);
  EXACT vec4 x = to.x - from.x;
  EXACT vec4 y = to.y - from.y;
  EXACT vec4 z = to.z - from.z;
  return three_of(x, y, z);
}

FN vec3 number(IN(Three) all, int k) { return vec3(all.x[k], all.y[k], all.z[k]); }

FN Three cross_of_each(IN(vec3) a, IN(Three) b) {
  EXACT vec4 x = b.z * a.y - b.y * a.z;
  EXACT vec4 y = b.x * a.z - b.z * a.x;
  EXACT vec4 z = b.y * a.x - b.x * a.y;
  return three_of(x, y, z);
}

FN Three cross_of_each(IN(Three) a, IN(Three) b) {
  EXACT vec4 x = a.y * b.z - a.z * b.y;
  EXACT vec4 y = a.z * b.x - a.x * b.z;
  EXACT vec4 z = a.x * b.y - a.y * b.x;
  return three_of(x, y, z);
}

// The shadows of all on one axis, and of one point on all axes. They round alike.
FN vec4 shadows(IN(vec3) axis, IN(Three) points) {
  EXACT vec4 sum = (points.x * axis.x + points.y * axis.y) + points.z * axis.z;
  return sum;
}
FN vec4 shadows(IN(Three) axes, IN(vec3) point) {
  EXACT vec4 sum = (axes.x * point.x + axes.y * point.y) + axes.z * point.z;
  return sum;
}

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
FN vec4 shadow_errors(IN(Three) axes, IN(vec3) reach) {
  EXACT vec4 sum = (abs(axes.x) * reach.x + abs(axes.y) * reach.y) + abs(axes.z) * reach.z;
  EXACT vec4 bound = sum * (9.0f / 8388608.0f) + vec4(1e-30f);
  return bound;
}

// Are the shadows of a and b certainly apart?
FN bool certainly_apart(IN(vec3) axis, IN(Three) a, IN(Three) b, IN(vec3) reach) {
  vec4 of_a = shadows(axis, a), of_b = shadows(axis, b);
  EXACT float gap = max(least_of(of_b) - largest_of(of_a), least_of(of_a) - largest_of(of_b));
  return gap > shadow_error(axis, reach);
}

// Are they on one of the axes whose bits are set?
FN bool certainly_apart(IN(Three) axes, uint among, IN(Three) a, IN(Three) b, IN(vec3) reach) {
  vec4 a0 = shadows(axes, number(a, 0)), a1 = shadows(axes, number(a, 1)), a2 = shadows(axes, number(a, 2));
  vec4 b0 = shadows(axes, number(b, 0)), b1 = shadows(axes, number(b, 1)), b2 = shadows(axes, number(b, 2));
  EXACT vec4 gap = max(min(min(b0, b1), b2) - max(max(a0, a1), a2), min(min(a0, a1), a2) - max(max(b0, b1), b2));
  return (bits_above(gap, shadow_errors(axes, reach)) & among) != 0u;
}

// On which side of `own` each of `other` is along an axis. Bits 0 to 3: its shadow is certainly above all those of `own`. Bits 4 to 7: it
// is certainly below.
FN uint certain_sides(IN(vec3) axis, IN(Three) own, IN(Three) other, IN(vec3) reach) {
  vec4 of_own = shadows(axis, own), of_other = shadows(axis, other), bound = vec4(shadow_error(axis, reach));
  EXACT vec4 above = of_other - vec4(largest_of(of_own));
  EXACT vec4 below = vec4(least_of(of_own)) - of_other;
  return bits_above(above, bound) | (bits_above(below, bound) << 4u);
}

FN bool one_sided(uint sides) { return (sides & 15u) == 15u || sides >> 4u == 15u; }
FN bool all_certain(uint sides) { return ((sides | sides >> 4u) & 7u) == 7u; }

// The edges, as bits, whose two ends are not certainly on one side. Bit 3 is that of the first corner again.
FN uint edges_across(uint sides) {
  uint on_one_side = sides & sides >> 1u;
  return ~(on_one_side | on_one_side >> 4u) & 7u;
}

// Returns false only if the closed triangles a and b [any unit] have no point in common. Returns true for NaN, infinities, and pairs
// smaller than 1e-19 or larger than 1e30. The answer may depend on the order of vertices only for pairs too close to tell.
FN bool triangles_may_touch(IN_ARRAY(vec3, a, 3), IN_ARRAY(vec3, b, 3)) {
  Three corners_a = three(a[0], a[1], a[2]), corners_b = three(b[0], b[1], b[2]);
  Three p = less(corners_a, a[0]), q = less(corners_b, a[0]);  // so that an offset costs no digits
  EXACT vec4 sizes = ((abs(p.x) + abs(p.y)) + abs(p.z)) + ((abs(q.x) + abs(q.y)) + abs(q.z));
  EXACT float size = (sizes.x + sizes.y) + sizes.z;
  if (!(size > 1e-19f && size < 1e30f)) return true;  // also for NaN

  // A power of two between 2^-100 and 2^64 scales the points exactly, so that size lies between 1 and 2.
  float scale = uintBitsToFloat(0x7f000000u - (floatBitsToUint(size) & 0x7f800000u));
  p = scaled(p, scale);
  q = scaled(q, scale);
  vec3 reach = vec3(largest_of(max(abs(p.x), abs(q.x))), largest_of(max(abs(p.y), abs(q.y))), largest_of(max(abs(p.z), abs(q.z)))) +
               vec3(1e-9f);

  Three edges_a = scaled(edges_of(a), scale), edges_b = scaled(edges_of(b), scale);
  uint sides_b = certain_sides(ordered_cross(number(edges_a, 0), number(edges_a, 1)), p, q, reach);
  if (one_sided(sides_b)) return false;
  uint sides_a = certain_sides(ordered_cross(number(edges_b, 0), number(edges_b, 1)), q, p, reach);
  if (one_sided(sides_a)) return false;

  // Each triangle covers a stretch of the line that both planes share. The stretches end on edges that cross the other plane. If
  // the stretches are apart, two of their ends face each other. A plane that holds the directions of both ends' edges then parts
  // the triangles.
  uint across_a = edges_across(sides_a), across_b = edges_across(sides_b);
  for (int i = 0; i < 3; ++i) {
    if ((across_a >> i & 1u) != 0u && certainly_apart(cross_of_each(number(edges_a, i), edges_b), across_b, p, q, reach)) return false;
  }
  if (all_certain(sides_a) && all_certain(sides_b)) return true;

  // Coplanar triangles part along a normal of an edge in their plane. Triangles without area may part along the line between their
  // centres. That line never runs along an edge whose normal parts the triangles, because the centres lie on the edge's two sides.
  EXACT vec3 between = ((number(q, 0) + number(q, 1)) + number(q, 2)) - ((number(p, 0) + number(p, 1)) + number(p, 2));
  return !certainly_apart(between, p, q, reach) &&
         !certainly_apart(cross_of_each(cross_of_each(between, edges_a), edges_a), 7u, p, q, reach) &&
         !certainly_apart(cross_of_each(cross_of_each(between, edges_b), edges_b), 7u, p, q, reach);
}

SHARED_END
#endif
