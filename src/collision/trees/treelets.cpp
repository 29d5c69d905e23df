#include "collision/trees/treelets.hpp"

#include <algorithm>

namespace pliant {
namespace {

// Gives nodes with children, from `first` on, their heights. Children stand behind their parent. Returns one past the last such
// node.
std::uint32_t set_heights(std::vector<glm::uvec4>& nodes, std::uint32_t first) {
  std::uint32_t end = first;
  for (auto n = static_cast<std::uint32_t>(nodes.size()); n-- > first;) {
    glm::uvec4& node = nodes[n];
    if (node.x == 0) continue;
    end = std::max(end, n + 1);
    for (std::uint32_t child = node.x; child < node.y; ++child)
      node.z = std::max(node.z, nodes[child].x == 0 ? 1 : nodes[child].z + 1);
  }
  return end;
}

// Appends a node and all below it, level by level. Returns how many levels they have.
std::uint32_t append_nodes(Treelets& all, const Forest& forest, std::uint32_t root) {
  std::uint32_t levels = 0;
  std::vector<std::uint32_t> level = {root}, next;
  auto number_of_next = static_cast<std::uint32_t>(all.nodes.size()) + 1;
  for (; !level.empty(); ++levels) {
    next.clear();
    for (const std::uint32_t at : level) {
      const TreeNode& node = forest.nodes[at];
      if (node.is_leaf())
        all.nodes.emplace_back(0, 0, node.first_triangle, node.end_of_triangles());
      else
        all.nodes.emplace_back(number_of_next, number_of_next + node.child_count, 0, 0);
      all.in_forest.push_back(at);
      number_of_next += node.child_count;
      for (std::uint32_t k = 0; k < node.child_count; ++k) next.push_back(node.first_child + k);
    }
    level.swap(next);
  }
  return levels;
}

void append_vertices(Treelets& all, const Forest& forest, const TreeNode& node) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t t = node.first_triangle; t < node.end_of_triangles(); ++t)
    vertices.insert(vertices.end(), forest.triangles[t].begin(), forest.triangles[t].end());
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  all.vertices.insert(all.vertices.end(), vertices.begin(), repeated.begin());
}

}  // namespace

std::vector<std::uint32_t> roots_of_treelets(const Forest& forest, std::uint32_t root, std::uint32_t most_triangles) {
  std::vector<std::uint32_t> found, open = {root};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    const TreeNode& node = forest.nodes[at];
    open.pop_back();
    if (node.is_leaf() || node.triangle_count <= most_triangles)
      found.push_back(at);
    else
      for (std::uint32_t child = node.end_of_children(); child-- > node.first_child;) open.push_back(child);
  }
  return found;
}

Treelets cut_into_treelets(const Forest& forest, std::uint32_t most_triangles) {
  Treelets all;
  for (std::uint32_t body = 0; body < forest.roots.size(); ++body) {
    const auto first = static_cast<std::uint32_t>(all.treelets.size());
    glm::uvec4 tree(first, 0, 0, 0);
    if (const std::uint32_t root = forest.roots[body]; root != no_node) {
      for (const std::uint32_t at : roots_of_treelets(forest, root, most_triangles)) {
        physics::Treelet treelet{};
        treelet.body = body;
        treelet.first_node = static_cast<std::uint32_t>(all.nodes.size());
        treelet.levels = append_nodes(all, forest, at);
        treelet.end_node = static_cast<std::uint32_t>(all.nodes.size());
        treelet.end_inner = set_heights(all.nodes, treelet.first_node);
        treelet.first_vertex = static_cast<std::uint32_t>(all.vertices.size());
        append_vertices(all, forest, forest.nodes[at]);
        treelet.end_vertex = static_cast<std::uint32_t>(all.vertices.size());
        all.treelets.push_back(treelet);
      }
      const TreeNode& whole = forest.nodes[root];
      tree = {first, all.treelets.size() - first, whole.first_triangle, whole.end_of_triangles()};
    }
    all.trees.push_back(tree);
  }
  return all;
}

}  // namespace pliant
