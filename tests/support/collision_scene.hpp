// Two spheres about to collide: a small scene in which every kernel has work.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "support/evolve.hpp"

namespace pliant {

/// Bodies of 162 and 42 vertices that meet within a few steps of 0.01 s. The left one spins.
inline std::vector<BodySetup> colliding_spheres() {
  BodySetup left = sphere(2), right = sphere(1);
  left.description.name = "left";
  left.description.position = {-1.05, 0.1, 0};
  left.description.velocity = {2, 0, 0};
  left.description.spin = {0.5, 0, 1};
  left.description.stiffness = 10;
  right.description.name = "right";
  right.description.position = {1.05, -0.1, 0.05};
  right.description.velocity = {-2, 0, 0};
  right.description.stiffness = 20;
  return {left, right};
}

/// Returns whether a search starts from the node or from one above it.
inline bool is_kept(const TreeNode& node, std::uint32_t triangles_of_a_treelet) {
  return node.is_leaf() || node.triangle_count <= triangles_of_a_treelet;
}

/// Returns how many nodes all trees have from where searches start down.
inline std::uint64_t nodes_of_a_search(const Collider& collider) {
  return static_cast<std::uint64_t>(std::ranges::count_if(
      collider.forest().nodes, [&](const TreeNode& node) { return is_kept(node, collider.trees().triangles_of_a_treelet()); }));
}

}  // namespace pliant
