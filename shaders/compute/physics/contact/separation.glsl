// Do two triangles stay apart while their corners move straight from start to end? An axis proves it if their shadows on it are apart at
// both ends, on the same sides: the distance of shadows is concave in time, so it is apart at all times between.
// Axes may be rounded freely. Only the shadows' errors have to be bounded.
#ifndef SEPARATION_GLSL
#define SEPARATION_GLSL
#include "features.glsl"
REAL_BEGIN

// Corners 0 to 2 are the first triangle's. Points are relative to a place near by, and finite: other steps end the run.
struct Motion {
  real3 start[6];
  real3 end[6];
  real margin;  // how far apart shadows have to be on an axis whose components sum to 1
};

FN real shadow(IN(real3) axis, IN(real3) p) {
  EXACT real sum = (axis.x * p.x + axis.y * p.y) + axis.z * p.z;
  return sum;
}

// Returns the distance of the shadows, positive where the first triangle's is above the second's.
FN real shadow_gap(IN(real3) axis, IN_ARRAY(real3, p, 6)) {
  real a = min(min(shadow(axis, p[0]), shadow(axis, p[1])), shadow(axis, p[2]));
  real b = max(max(shadow(axis, p[3]), shadow(axis, p[4])), shadow(axis, p[5]));
  EXACT real gap = a - b;
  return gap;
}

FN bool stays_above(IN(real3) axis, IN(Motion) m) {
  real least = m.margin * ((abs(axis.x) + abs(axis.y)) + abs(axis.z));
  return shadow_gap(axis, m.start) > least && shadow_gap(axis, m.end) > least;
}

// Returns the difference of two corners, one of each triangle, that goes least along the axis.
FN real3 least_difference(IN(real3) axis, IN_ARRAY(real3, p, 6)) {
  real3 first = p[0], second = p[3];
  for (int k = 1; k < 3; ++k) {
    if (dot(axis, p[k]) < dot(axis, first)) first = p[k];
    if (dot(axis, p[3 + k]) > dot(axis, second)) second = p[3 + k];
  }
  return first - second;
}

// A corner, a line, a triangle or a tetrahedron.
struct Simplex {
  real3 corner[4];
  int corners;
};

// These return a simplex's point that is closest to the origin, and leave the corners that it lies between.
FN real3 closest_on_line(INOUT(Simplex) s) {
  real3 line = s.corner[1] - s.corner[0];
  real along = -dot(s.corner[0], line), square = dot(line, line);
  if (along > real(0) && along < square) return s.corner[0] + (along / square) * line;
  if (along >= square) s.corner[0] = s.corner[1];
  s.corners = 1;
  return s.corner[0];
}

FN real3 closest_on_face(INOUT(Simplex) s) {
  real3 weight = closest_on_triangle(real3(0), s.corner[0], s.corner[1], s.corner[2]);
  real3 closest = weight.x * s.corner[0] + weight.y * s.corner[1] + weight.z * s.corner[2];
  s.corners = 0;
  for (int k = 0; k < 3; ++k)
    if (weight[k] > real(0)) s.corner[s.corners++] = s.corner[k];
  return closest;
}

// It lies on one of the three faces at the latest corner, unless the origin is inside. Faces without an area have no point.
FN real3 closest_on_tetrahedron(INOUT(Simplex) s) {
  Simplex best = s;
  best.corner[0] = s.corner[3];
  best.corners = 1;
  real3 closest = s.corner[3];
  for (int k = 0; k < 3; ++k) {
    Simplex face = s;
    face.corner[0] = s.corner[3];
    face.corner[1] = s.corner[k];
    face.corner[2] = s.corner[k == 2 ? 0 : k + 1];
    real3 on_face = closest_on_face(face);
    if (!(dot(on_face, on_face) <= dot(closest, closest))) continue;
    best = face;
    closest = on_face;
  }
  s = best;
  return closest;
}

FN real3 closest_to_origin(INOUT(Simplex) s) {
  if (s.corners == 1) return s.corner[0];
  if (s.corners == 2) return closest_on_line(s);
  return s.corners == 3 ? closest_on_face(s) : closest_on_tetrahedron(s);
}

// Across a face the normal is a better axis than the closest point, which is rounded by the size of the corners.
FN real3 axis_across(IN(Simplex) s, IN(real3) closest) {
  if (s.corners != 3) return closest;
  real3 normal = cross(s.corner[1] - s.corner[0], s.corner[2] - s.corner[0]);
  if (!(dot(normal, normal) > real(0))) return closest;
  return dot(normal, s.corner[0]) < real(0) ? -normal : normal;
}

// Triangles that share a corner, the first one of either, stay apart elsewhere if a plane through it has the other two corners of each on its
// own side at both ends. Let ways lead from the shared corner to those of the first triangle, and from those of the second to the shared
// one. All of them have to go along the plane's normal.
FN bool all_go_along(IN(real3) axis, IN_ARRAY(real3, p, 6), real least) {
  bool all = true;
  for (int k = 1; k < 3; ++k)
    all = all && shadow(axis, p[k] - p[0]) > least && shadow(axis, p[3] - p[3 + k]) > least;
  return all;
}

// Whether the triangles are on their sides of a plane across the axis at both ends.
FN bool is_proof(IN(real3) axis, IN(Motion) m, bool share_a_corner) {
  if (!share_a_corner) return stays_above(axis, m);
  real least = m.margin * ((abs(axis.x) + abs(axis.y)) + abs(axis.z));
  return all_go_along(axis, m.start, least) && all_go_along(axis, m.end, least);
}

// Returns the one of a direction and that of a way that goes less along the axis.
FN real3 lesser_along(IN(real3) axis, IN(real3) direction, IN(real3) way) {
  real3 other = way / length(way);
  return dot(axis, other) < dot(axis, direction) ? other : direction;
}

// Returns the one of `least` and the directions of the ways between corners, as all_go_along() has them, that goes least along the axis.
FN real3 least_direction(IN(real3) axis, IN_ARRAY(real3, p, 6), real3 least) {
  for (int k = 1; k < 3; ++k) least = lesser_along(axis, lesser_along(axis, least, p[k] - p[0]), p[3] - p[3 + k]);
  return least;
}

// Of triangles that share a corner this returns the least direction at both ends. Of others it is the least difference of corners.
FN real3 least_along(IN(real3) axis, IN(Motion) m, bool share_a_corner) {
  if (share_a_corner) {
    real3 way = m.start[1] - m.start[0];
    return least_direction(axis, m.end, least_direction(axis, m.start, way / length(way)));
  }
  real3 at_start = least_difference(axis, m.start), at_end = least_difference(axis, m.end);
  return dot(axis, at_end) < dot(axis, at_start) ? at_end : at_start;
}

// Looks for an axis. If there is one, the closest point to the origin in the hull of all differences of corners, or of all directions, at
// both ends, is one, too.
// Source: E. Gilbert, D. Johnson and S. Keerthi, A fast procedure for computing the distance between complex objects (1988).
FN bool has_axis(IN(Motion) m, real3 axis, bool share_a_corner) {
  Simplex s;
  s.corners = 0;
  for (int k = 0; k < 16; ++k) {
    if (is_proof(axis, m, share_a_corner)) return true;
    s.corner[s.corners++] = least_along(axis, m, share_a_corner);
    real3 closest = closest_to_origin(s);
    axis = axis_across(s, closest);
  }
  return false;
}

// The normal of a triangle in the midst of its motion, along `between`.
FN real3 normal_of(IN(Motion) m, int first, IN(real3) between) {
  real3 a = m.start[first] + m.end[first], b = m.start[first + 1] + m.end[first + 1], c = m.start[first + 2] + m.end[first + 2];
  real3 normal = cross(b - a, c - a);
  return dot(normal, between) < real(0) ? -normal : normal;
}

// From the second triangle to the first, at the start.
FN real3 way_to_first(IN(Motion) m) {
  return ((m.start[0] + m.start[1]) + m.start[2]) - ((m.start[3] + m.start[4]) + m.start[5]);
}

// Whether a normal of one of the triangles proves it. It does for 99 % of pairs near each other at 0.05 edges a step, and for 82 % at 1.
FN bool a_normal_proves(IN(Motion) m) {
  real3 between = way_to_first(m);
  return stays_above(normal_of(m, 0, between), m) || stays_above(normal_of(m, 3, between), m);
}

// Do the triangles stay apart? kernels/certify.glsl asks both questions one after the other.
FN bool stays_apart(IN(Motion) m, bool share_a_corner) {
  return (!share_a_corner && a_normal_proves(m)) || has_axis(m, way_to_first(m), share_a_corner);
}
FN bool stays_apart(IN(Motion) m) { return stays_apart(m, false); }

// The same motion from one part of its time to another.
FN Motion between(IN(Motion) m, real from, real to) {
  if (from == real(0) && to == real(1)) return m;
  Motion p = m;
  for (int k = 0; k < 6; ++k) {
    p.start[k] = m.start[k] + from * (m.end[k] - m.start[k]);
    p.end[k] = m.start[k] + to * (m.end[k] - m.start[k]);
  }
  return p;
}

// The same in pieces of the time, down to such a part of it. Triangles that turn together may need another axis for each piece. After a
// piece that was proven, one of twice its length is tried.
FN bool stays_apart_in_pieces(IN(Motion) m, bool share_a_corner, real shortest) {
  real from = real(0), piece = real(1);
  while (from < real(1)) {
    if (stays_apart(between(m, from, from + piece), share_a_corner)) {
      from += piece;
      piece = min(real(2) * piece, real(1) - from);
    } else {
      piece *= real(0.5);
      if (piece < shortest) return false;
    }
  }
  return true;
}

REAL_END
#endif
