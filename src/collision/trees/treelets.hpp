// Cuts trees into treelets (physics/collision/treelet.glsl), and numbers nodes as devices have them.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "collision/trees/tree.hpp"
#include "physics/collision/treelet.glsl"

namespace pliant {

struct Treelets {
  std::vector<physics::Treelet> treelets;  // of all bodies, one after another
  std::vector<glm::uvec4> trees;           // for each body: its first treelet, how many it has, its first triangle, and their end
  // First child, one past the last, height above the lowest leaf, 0. Of a leaf 0, 0, first triangle, and their end
  std::vector<glm::uvec4> nodes;
  std::vector<std::uint32_t> in_forest;  // each of these nodes' number in the forest
  std::vector<std::uint32_t> vertices;   // of each treelet's triangles, each once
};

/// Returns where a tree is cut: the highest nodes that have `most_triangles` or fewer, or are leaves, in the order of triangles.
[[nodiscard]] std::vector<std::uint32_t> roots_of_treelets(const Forest& forest, std::uint32_t root,
                                                           std::uint32_t most_triangles);

/// Cuts each tree there. Nodes above are left out.
[[nodiscard]] Treelets cut_into_treelets(const Forest& forest, std::uint32_t most_triangles);

}  // namespace pliant
