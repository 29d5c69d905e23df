#include "collision/contacts/exact_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace pliant::testing {
namespace {

__extension__ using Wide = __int128;  // products of three differences take 69 bits, of four 94
using Wide3 = glm::vec<3, Wide>;

Wide3 difference(const Lattice3& a, const Lattice3& b) { return {Wide(a.x - b.x), Wide(a.y - b.y), Wide(a.z - b.z)}; }
Wide3 cross_product(const Wide3& a, const Wide3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Wide dot_product(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
bool is_zero(const Wide3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
int sign(Wide value) { return (value > 0) - (value < 0); }

/// On which side of the plane through a, b, c the point lies.
int side(const Lattice3& a, const Lattice3& b, const Lattice3& c, const Lattice3& point) {
  return sign(dot_product(cross_product(difference(b, a), difference(c, a)), difference(point, a)));
}

bool on_segment(const Lattice3& point, const Lattice3& p, const Lattice3& q) {
  if (!is_zero(cross_product(difference(point, p), difference(q, p)))) return false;
  return dot_product(difference(point, p), difference(point, q)) <= 0;
}

bool segments_touch(const Lattice3& p, const Lattice3& q, const Lattice3& r, const Lattice3& s) {
  const Wide3 normal = cross_product(difference(q, p), difference(s, r));
  if (is_zero(normal)) return on_segment(p, r, s) || on_segment(q, r, s) || on_segment(r, p, q) || on_segment(s, p, q);
  if (dot_product(normal, difference(r, p)) != 0) return false;
  const auto parts = [&](const Lattice3& from, const Lattice3& to, const Lattice3& c, const Lattice3& d) {
    const Wide3 inward = cross_product(normal, difference(to, from));
    return sign(dot_product(inward, difference(c, from))) * sign(dot_product(inward, difference(d, from))) > 0;
  };
  return !parts(p, q, r, s) && !parts(r, s, p, q);
}

bool same_sign(int a, int b, int c) { return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); }

/// Whether the segment meets the triangle's inside. Other functions test the border.
bool pierces(const Lattice3& p, const Lattice3& q, const LatticeTriangle& t) {
  const Wide3 normal = cross_product(difference(t[1], t[0]), difference(t[2], t[0]));
  if (is_zero(normal)) return false;
  const int side_p = side(t[0], t[1], t[2], p), side_q = side(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {  // the segment lies in the plane: an end is inside, or it crosses the border
    const auto along = [&](int i) {
      const Lattice3 &from = t[static_cast<std::size_t>(i)], &to = t[static_cast<std::size_t>((i + 1) % 3)];
      return sign(dot_product(normal, cross_product(difference(to, from), difference(p, from))));
    };
    return same_sign(along(0), along(1), along(2));
  }
  return same_sign(side(p, q, t[0], t[1]), side(p, q, t[1], t[2]), side(p, q, t[2], t[0]));
}

bool edges_reach(const LatticeTriangle& a, const LatticeTriangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Lattice3 &p = a[i], &q = a[(i + 1) % 3];
    if (pierces(p, q, b)) return true;
    for (std::size_t j = 0; j < 3; ++j) {
      if (segments_touch(p, q, b[j], b[(j + 1) % 3])) return true;
    }
  }
  return false;
}

using Corners = std::array<glm::dvec3, 3>;

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 along = q - p;
  const double squared = glm::dot(along, along);
  const double t = squared > 0 ? glm::clamp(glm::dot(point - p, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(point - (p + t * along));
}

/// The distance to the inside of the triangle, if the foot of the perpendicular lies there.
double distance_to_inside(const glm::dvec3& point, const Corners& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(glm::dot(normal, glm::cross(t[(i + 1) % 3] - t[i], point - t[i])) > 0)) return std::numeric_limits<double>::infinity();
  }
  return std::abs(glm::dot(normal, point - t[0])) / glm::length(normal);
}

/// The distance between the lines of two segments, if their nearest points lie inside the segments.
double distance_of_insides(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) {
  const glm::dvec3 normal = glm::cross(q - p, s - r);
  const double squared = glm::dot(normal, normal);
  const double t = glm::dot(glm::cross(r - p, s - r), normal), u = glm::dot(glm::cross(r - p, q - p), normal);
  const bool inside = squared > 0 && t >= 0 && t <= squared && u >= 0 && u <= squared;
  return inside ? std::abs(glm::dot(normal, r - p)) / std::sqrt(squared) : std::numeric_limits<double>::infinity();
}

double distance_one_way(const Corners& a, const Corners& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    nearest = std::min(nearest, distance_to_inside(a[i], b));
    for (std::size_t j = 0; j < 3; ++j) {
      nearest = std::min(nearest, distance_to_segment(a[i], b[j], b[(j + 1) % 3]));
      nearest = std::min(nearest, distance_of_insides(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
  }
  return nearest;
}

Corners corners(const Triangle& t) { return {glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2])}; }

}  // namespace

bool exactly_touch(const LatticeTriangle& a, const LatticeTriangle& b) { return edges_reach(a, b) || edges_reach(b, a); }

double relative_gap(const Triangle& a, const Triangle& b) {
  glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper(-lower);
  for (const Triangle* triangle : {&a, &b}) {
    for (const glm::vec3& corner : *triangle) {
      lower = glm::min(lower, glm::dvec3(corner));
      upper = glm::max(upper, glm::dvec3(corner));
    }
  }
  const glm::dvec3 extent = upper - lower;
  return std::min(distance_one_way(corners(a), corners(b)), distance_one_way(corners(b), corners(a))) /
         std::max({extent.x, extent.y, extent.z});
}

}  // namespace pliant::testing
