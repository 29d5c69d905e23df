// How a node's triangles are shared out between its two children.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "scene/scene_description.hpp"

namespace pliant {

/// A box in fp64. The first one is empty.
struct TreeBox {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()};
  glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

  void add(const TreeBox& other);
  /// Returns half of the surface, or 0 if the box is empty.
  [[nodiscard]] double half_surface() const;
};

/// What a split needs to know of a triangle.
struct TreeItem {
  std::uint32_t triangle;
  glm::dvec3 centroid;
  TreeBox box;
};

/// Reorders the items in two parts and returns the size of the first. If either is empty, the items can't be split. Expects more
/// than `leaf_size` items.
[[nodiscard]] std::size_t split_items(TreeSplit split, std::span<TreeItem> items, unsigned leaf_size);

}  // namespace pliant
