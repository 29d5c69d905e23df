// Do two triangles stay apart while their corners move straight from start to end? An axis proves it if their shadows on it are apart at
// both ends, on the same sides: the distance of shadows is concave in time, so it is apart at all times between.
// Axes may be rounded freely. Only the shadows' errors have to be bounded.
#ifndef SEPARATION_GLSL
#define SEPARATION_GLSL
#include "features.glsl"
REAL_BEGIN

// Corners 0 to 2 are the first triangle's. Points are relative to a place near by.
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

FN bool stays_apart_on(IN(real3) axis, IN(Motion) m) { return stays_above(axis, m) || stays_above(-axis, m); }

FN bool stays_apart_on_faces(IN(Motion) m, IN_ARRAY(real3, p, 6)) {
  return stays_apart_on(cross(p[1] - p[0], p[2] - p[1]), m) || stays_apart_on(cross(p[4] - p[3], p[5] - p[4]), m);
}

FN bool stays_apart_on_edges(IN(Motion) m, IN_ARRAY(real3, p, 6)) {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) {
      int after_j = j == 2 ? 0 : j + 1, after_k = k == 2 ? 0 : k + 1;
      if (stays_apart_on(cross(p[after_j] - p[j], p[3 + after_k] - p[3 + k]), m)) return true;
    }
  return false;
}

// Tries the cheapest axes: those of coordinates, the line between the triangles' centres, and their normals.
FN bool stays_apart_at_a_glance(IN(Motion) m) {
  if (stays_apart_on(((m.start[0] + m.start[1]) + m.start[2]) - ((m.start[3] + m.start[4]) + m.start[5]), m)) return true;
  if (stays_apart_on(real3(1, 0, 0), m) || stays_apart_on(real3(0, 1, 0), m) || stays_apart_on(real3(0, 0, 1), m)) return true;
  return stays_apart_on_faces(m, m.start);
}

// Tries the axes on which touching triangles part, and those across the relative motion.
FN bool stays_apart_at_last(IN(Motion) m) {
  if (stays_apart_on_edges(m, m.start) || stays_apart_on_faces(m, m.end) || stays_apart_on_edges(m, m.end)) return true;
  real3 course = ((m.end[0] - m.start[0]) + (m.end[1] - m.start[1]) + (m.end[2] - m.start[2])) -
                 ((m.end[3] - m.start[3]) + (m.end[4] - m.start[4]) + (m.end[5] - m.start[5]));
  for (int k = 0; k < 3; ++k) {
    int after = k == 2 ? 0 : k + 1;
    if (stays_apart_on(cross(course, m.start[after] - m.start[k]), m)) return true;
    if (stays_apart_on(cross(course, m.start[3 + after] - m.start[3 + k]), m)) return true;
  }
  return false;
}

REAL_END
#endif
