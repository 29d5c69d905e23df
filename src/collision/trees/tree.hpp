// The structure of the bodies' bounding box trees, built once from rest positions. Boxes are refitted elsewhere.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "physics/control.glsl"

namespace pliant {

using physics::no_node;

/// One binary tree per body, all in the same arrays. A body's nodes are contiguous and stand level by level. So children follow
/// their parent, and a sweep from the last node to the first meets children before parents.
struct Forest {
  /// x: left child, or 0 in a leaf. The right child is next to it, and node 0 is a root, never a child.
  /// y: parent, or no_node in a root.
  /// z, w: first and one past the last triangle, in leaf order.
  std::vector<glm::uvec4> nodes;
  std::vector<glm::uvec2> leaves;                       // node, body, in the order of nodes
  std::vector<std::array<std::uint32_t, 3>> triangles;  // vertex indices, in leaf order
  std::vector<std::uint32_t> triangle_ids;              // leaf order -> index into Model::triangles
  std::vector<std::uint32_t> roots;                     // one for each body, no_node if it has no triangles
  std::vector<std::uint32_t> leaf_counts;               // one for each body, 0 if it has no triangles
  unsigned depth = 0;                                   // of the deepest node, where a root has depth 0
};

/// Returns the nodes of a body from which a search may start. They are leaves, and the highest nodes that have `most_triangles`
/// or fewer.
[[nodiscard]] std::vector<std::uint32_t> start_nodes(const Forest& forest, std::uint32_t body, std::uint32_t most_triangles);

/// Builds all trees, top-down. A node of more than leaf_size triangles above max_depth is split. One that cannot be split is a
/// leaf, whatever its size. `positions` are those of the model's vertices (rest or world) [m]. They must be finite, and w is
/// ignored.
[[nodiscard]] Forest build_forest(const Model& model, std::span<const glm::vec4> positions, const TreeDescription& description);

}  // namespace pliant
