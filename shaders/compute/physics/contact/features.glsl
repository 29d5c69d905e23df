// Closest points of two triangles' features: a vertex and a triangle, or two edges. Points are relative to a place near by.
// Source: C. Ericson, Real-Time Collision Detection (2005), chapter 5.1.
#ifndef FEATURES_GLSL
#define FEATURES_GLSL
#include "../language.glsl"
REAL_BEGIN
#ifdef __cplusplus
using glm::clamp;
#endif

// Returns the weights of the corners a, b and c in the point of their triangle that is closest to p.
FN real3 closest_on_triangle(IN(real3) p, IN(real3) a, IN(real3) b, IN(real3) c) {
  real3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  real a_b = dot(ab, ap), a_c = dot(ac, ap), b_b = dot(ab, bp), b_c = dot(ac, bp), c_b = dot(ab, cp), c_c = dot(ac, cp);
  if (a_b <= real(0) && a_c <= real(0)) return real3(1, 0, 0);
  if (b_b >= real(0) && b_c <= b_b) return real3(0, 1, 0);
  if (c_c >= real(0) && c_b <= c_c) return real3(0, 0, 1);
  real of_c = a_b * b_c - b_b * a_c;
  if (of_c <= real(0) && a_b >= real(0) && b_b <= real(0)) {
    real s = a_b / (a_b - b_b);
    return real3(real(1) - s, s, 0);
  }
  real of_b = c_b * a_c - a_b * c_c;
  if (of_b <= real(0) && a_c >= real(0) && c_c <= real(0)) {
    real s = a_c / (a_c - c_c);
    return real3(real(1) - s, 0, s);
  }
  real of_a = b_b * c_c - c_b * b_c;
  if (of_a <= real(0) && b_c - b_b >= real(0) && c_b - c_c >= real(0)) {
    real s = (b_c - b_b) / ((b_c - b_b) + (c_b - c_c));
    return real3(0, real(1) - s, s);
  }
  real all = of_a + of_b + of_c;
  return real3(of_a / all, of_b / all, of_c / all);
}

// Where two edges are closest: the weights of b in (a, b) and of d in (c, d). `crosses` says whether both places are inside the edges.
struct Crossing {
  real on_first;
  real on_second;
  bool crosses;
};

FN real from_0_to_1(real number) { return min(max(number, real(0)), real(1)); }

// Edges that are parallel, as far as numbers tell, do not cross.
FN Crossing crossing_of(IN(real3) a, IN(real3) b, IN(real3) c, IN(real3) d) {
  real3 first = b - a, second = d - c, between = a - c;
  real ff = dot(first, first), ss = dot(second, second), fs = dot(first, second);
  real fb = dot(first, between), sb = dot(second, between);
  real square = ff * ss - fs * fs;
  bool is_parallel = !(square > real(64) * real_epsilon * (ff * ss));
  real on_first = is_parallel ? real(0) : (fs * sb - fb * ss) / square;
  Crossing found;
  found.on_first = from_0_to_1(on_first);
  real on_second = (fs * found.on_first + sb) / ss;
  found.on_second = from_0_to_1(on_second);
  if (found.on_second != on_second) found.on_first = from_0_to_1((fs * found.on_second - fb) / ff);
  found.crosses = !is_parallel && found.on_first > real(0) && found.on_first < real(1) && found.on_second > real(0) &&
                  found.on_second < real(1);
  return found;
}

// Closest points of two triangles, with corners 0 to 2 and 3 to 5. `away` leads from the second's point to the first's.
struct Closest {
  real3 away;
  real distance;
};

FN Closest nearer(Closest a, real3 away) {
  real distance = length(away);
  if (!(distance < a.distance)) return a;
  a.away = away;
  a.distance = distance;
  return a;
}

// Expects triangles that do not intersect.
FN Closest closest_points(IN_ARRAY(real3, p, 6)) {
  Closest found;
  found.away = p[0] - p[3];
  found.distance = length(found.away);
  for (int k = 0; k < 3; ++k) {
    real3 w = closest_on_triangle(p[k], p[3], p[4], p[5]);
    found = nearer(found, p[k] - (w.x * p[3] + w.y * p[4] + w.z * p[5]));
    real3 v = closest_on_triangle(p[3 + k], p[0], p[1], p[2]);
    found = nearer(found, (v.x * p[0] + v.y * p[1] + v.z * p[2]) - p[3 + k]);
  }
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) {
      int after_j = j == 2 ? 0 : j + 1, after_k = k == 2 ? 0 : k + 1;
      Crossing at = crossing_of(p[j], p[after_j], p[3 + k], p[3 + after_k]);
      found = nearer(found, (p[j] + at.on_first * (p[after_j] - p[j])) - (p[3 + k] + at.on_second * (p[3 + after_k] - p[3 + k])));
    }
  return found;
}

REAL_END
#endif
