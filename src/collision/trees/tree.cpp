#include "collision/trees/tree.hpp"

#include <algorithm>
#include <bit>
#include <glm/vec3.hpp>
#include <utility>

#include "collision/trees/split.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

TreeItem make_item(const Model& model, std::span<const glm::vec4> positions, std::uint32_t triangle) {
  TreeItem item{triangle, glm::dvec3(0.0), {}};
  for (const std::uint32_t vertex : model.triangles[triangle]) {
    const glm::dvec3 corner(positions[vertex]);
    item.centroid += corner / 3.0;
    item.box.add({corner, corner});
  }
  return item;
}

/// Returns the depth of even splits and slack for uneven ones. Beyond it no leaf of the bunny or the teapot splits any further:
/// split at the centre, they need 5 and 6 levels more than even splits would. Icospheres need 2, and other splits fewer.
unsigned default_depth(std::size_t triangle_count, unsigned leaf_size) {
  constexpr unsigned slack = 6;
  return static_cast<unsigned>(std::bit_width(triangle_count / leaf_size)) + slack;
}

class BodyTree {
 public:
  BodyTree(Forest& forest, const TreeDescription& description, std::vector<TreeItem> items)
      : forest_(forest),
        description_(description),
        items_(std::move(items)),
        first_triangle_(static_cast<std::uint32_t>(forest.triangles.size())),
        max_depth_(description.max_depth.value_or(default_depth(items_.size(), description.leaf_size))) {}

  /// Appends nodes level by level: a node's children go to the end while the nodes before are already settled.
  void build() {
    const std::size_t root = forest_.nodes.size();
    append(no_node, 0, items_.size());
    for (std::size_t level_begin = root, depth = 0; level_begin < forest_.nodes.size(); ++depth) {
      const std::size_t level_end = forest_.nodes.size();
      for (std::size_t node = level_begin; node < level_end; ++node) settle(node, depth);
      level_begin = level_end;
      forest_.depth = std::max(forest_.depth, static_cast<unsigned>(depth));
    }
  }

  [[nodiscard]] const std::vector<TreeItem>& items() const { return items_; }

 private:
  void append(std::uint32_t parent, std::size_t begin, std::size_t end) {
    forest_.nodes.emplace_back(0, parent, first_triangle_ + begin, first_triangle_ + end);
  }

  /// Splits the node if it should and can be split.
  void settle(std::size_t node, std::size_t depth) {
    const std::size_t begin = forest_.nodes[node].z - first_triangle_;
    const std::size_t end = forest_.nodes[node].w - first_triangle_;
    if (end - begin <= description_.leaf_size || depth >= max_depth_) return;
    const std::size_t middle =
        begin + split_items(description_.split, std::span(items_).subspan(begin, end - begin), description_.leaf_size);
    if (middle == begin || middle == end) return;
    forest_.nodes[node].x = static_cast<std::uint32_t>(forest_.nodes.size());
    append(static_cast<std::uint32_t>(node), begin, middle);
    append(static_cast<std::uint32_t>(node), middle, end);
  }

  Forest& forest_;
  const TreeDescription& description_;
  std::vector<TreeItem> items_;
  std::uint32_t first_triangle_;
  unsigned max_depth_;
};

void list_leaves(Forest& forest, std::uint32_t body, std::uint32_t first_node) {
  const std::size_t leaves_before = forest.leaves.size();
  for (std::uint32_t node = first_node; node < forest.nodes.size(); ++node) {
    if (forest.nodes[node].x == 0) forest.leaves.emplace_back(node, body);
  }
  forest.leaf_counts.push_back(static_cast<std::uint32_t>(forest.leaves.size() - leaves_before));
}

void add_tree(Forest& forest, const Model& model, std::uint32_t body, std::span<const glm::vec4> positions,
              const TreeDescription& description) {
  const ModelBody& range = model.bodies[body];
  const auto first_node = static_cast<std::uint32_t>(forest.nodes.size());
  forest.roots.push_back(range.triangle_count > 0 ? first_node : no_node);
  if (range.triangle_count > 0) {
    std::vector<TreeItem> items;
    for (std::uint32_t i = 0; i < range.triangle_count; ++i)
      items.push_back(make_item(model, positions, range.first_triangle + i));
    BodyTree tree(forest, description, std::move(items));
    tree.build();
    for (const TreeItem& item : tree.items()) {
      forest.triangles.push_back(model.triangles[item.triangle]);
      forest.triangle_ids.push_back(item.triangle);
    }
  }
  list_leaves(forest, body, first_node);
}

}  // namespace

std::vector<std::uint32_t> start_nodes(const Forest& forest, std::uint32_t body, std::uint32_t most_triangles) {
  std::vector<std::uint32_t> starts, open;
  if (forest.roots[body] != no_node) open.push_back(forest.roots[body]);
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    const glm::uvec4& node = forest.nodes[at];
    open.pop_back();
    if (node.x == 0 || node.w - node.z <= most_triangles) {
      starts.push_back(at);
    } else {
      open.push_back(node.x + 1);
      open.push_back(node.x);
    }
  }
  return starts;
}

Forest build_forest(const Model& model, std::span<const glm::vec4> positions, const TreeDescription& description) {
  PLIANT_EXPECT(positions.size() == model.rest_positions.size());
  PLIANT_EXPECT(description.leaf_size > 0);
  Forest forest;
  for (std::uint32_t body = 0; body < model.bodies.size(); ++body) add_tree(forest, model, body, positions, description);
  return forest;
}

}  // namespace pliant
