// Boxes of bodies or triangles on the host, in fp64, and which of them are near each other.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace pliant {

struct IndexedBox {
  std::uint32_t index = 0;  // of the body or triangle
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};  // [m]

  void add(const glm::dvec3& place) {
    lower = glm::min(lower, place);
    upper = glm::max(upper, place);
  }
};

/// Returns whether the boxes are no further apart than that along any axis [m].
[[nodiscard]] inline bool are_near(const IndexedBox& a, const IndexedBox& b, double distance) {
  return glm::all(glm::lessThanEqual(a.lower, b.upper + distance)) && glm::all(glm::lessThanEqual(b.lower, a.upper + distance));
}

/// Calls visit(a, b) for each two boxes that are near, by a sweep along x.
template <class Visit>
void for_each_near(std::vector<IndexedBox> boxes, double distance, const Visit& visit) {
  std::ranges::sort(boxes, {}, [](const IndexedBox& box) { return box.lower.x; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lower.x <= boxes[i].upper.x + distance; ++j)
      if (are_near(boxes[i], boxes[j], distance)) visit(boxes[i], boxes[j]);
}

/// Returns the boxes of the body's triangles that are near the other box. `positions` are those of all vertices [m].
[[nodiscard]] inline std::vector<IndexedBox> triangles_near(const Model& model, const ModelBody& body,
                                                            std::span<const glm::dvec3> positions, const IndexedBox& other,
                                                            double distance) {
  std::vector<IndexedBox> boxes;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    IndexedBox box{.index = t};
    for (const std::uint32_t vertex : model.triangles[t]) box.add(positions[vertex]);
    if (are_near(box, other, distance)) boxes.push_back(box);
  }
  return boxes;
}

/// Calls visit(s, t) for each two triangles, one of each body, whose boxes are near. The bodies' own boxes are given, too.
template <class Visit>
void for_each_near_triangles(const Model& model, const ModelBody& a, const IndexedBox& box_a, const ModelBody& b,
                             const IndexedBox& box_b, std::span<const glm::dvec3> positions, double distance,
                             const Visit& visit) {
  std::vector<IndexedBox> boxes = triangles_near(model, a, positions, box_b, distance);
  const std::vector<IndexedBox> others = triangles_near(model, b, positions, box_a, distance);
  boxes.insert(boxes.end(), others.begin(), others.end());
  const auto is_of_a = [&](const IndexedBox& box) { return box.index - a.first_triangle < a.triangle_count; };
  for_each_near(std::move(boxes), distance, [&](const IndexedBox& s, const IndexedBox& t) {
    if (is_of_a(s) != is_of_a(t)) visit(s.index, t.index);
  });
}

}  // namespace pliant
