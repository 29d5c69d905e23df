// Boxes of bodies or triangles on the host, in fp64, and which of them are near each other.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

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

}  // namespace pliant
