// The structure of the bodies' bounding box trees, built once from rest positions. Boxes are refitted elsewhere.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

inline constexpr std::uint32_t no_node = 0xffffffffu;  // parent of a root, or root of a body without triangles

struct TreeNode {
  std::uint32_t parent = no_node;                        // none of a root
  std::uint32_t first_child = 0, child_count = 0;        // none in a leaf
  std::uint32_t first_triangle = 0, triangle_count = 0;  // in leaf order

  [[nodiscard]] bool is_leaf() const { return child_count == 0; }
  [[nodiscard]] std::uint32_t end_of_children() const { return first_child + child_count; }
  [[nodiscard]] std::uint32_t end_of_triangles() const { return first_triangle + triangle_count; }
};

/// One tree per body, all in the same arrays. A body's nodes are contiguous and stand level by level, and so siblings are
/// contiguous behind their parent.
struct Forest {
  std::vector<TreeNode> nodes;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // vertex indices, in leaf order
  std::vector<std::uint32_t> triangle_ids;              // leaf order -> index into Model::triangles
  std::vector<std::uint32_t> roots;                     // one for each body, no_node if it has no triangles
  std::vector<bool> self_contact;                       // for each body, whether its tree is compared with itself, too
  unsigned depth = 0;                                   // of the deepest node, where a root has depth 0
};

/// Builds all trees, top-down. A part of more than leaf_size triangles below fewer than max_depth splits is split in two. One
/// that cannot be split is a leaf, whatever its size. So leaves are the same for each fan-out, and in the same order. `positions`
/// are those of the model's vertices (rest or world) [m]. They must be finite, and w is ignored.
[[nodiscard]] Forest build_forest(const Model& model, std::span<const glm::vec4> positions, const TreeDescription& description);

}  // namespace pliant
