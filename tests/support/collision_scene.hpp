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

/// Returns how many nodes all trees have from where searches start down.
inline std::uint64_t nodes_of_a_search(const Collider& collider) {
  std::vector<unsigned> depths;
  for (const glm::uvec4& node : collider.forest().nodes) depths.push_back(node.y == no_node ? 0 : depths[node.y] + 1);
  return static_cast<std::uint64_t>(
      std::ranges::count_if(depths, [&](unsigned depth) { return depth >= collider.trees().start_depth(); }));
}

}  // namespace pliant
