#include "collision/trees/tree.hpp"

#include <algorithm>
#include <bit>
#include <glm/vec3.hpp>
#include <utility>

#include "collision/trees/split.hpp"
#include "core/expect.hpp"
#include "physics/collision/treelet.glsl"

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
        splits_of_a_node_(static_cast<unsigned>(std::bit_width(description.fan_out)) - 1),
        items_(std::move(items)),
        first_triangle_(static_cast<std::uint32_t>(forest.triangles.size())),
        max_depth_(description.max_depth.value_or(default_depth(items_.size(), description.leaf_size))) {}

  /// Appends nodes level by level: a node's children go to the end while the nodes before are already settled.
  void build() {
    const std::size_t root = forest_.nodes.size();
    forest_.nodes.push_back({.first_triangle = first_triangle_, .triangle_count = static_cast<std::uint32_t>(items_.size())});
    for (std::size_t level_begin = root, depth = 0; level_begin < forest_.nodes.size(); ++depth) {
      const std::size_t level_end = forest_.nodes.size();
      for (std::size_t node = level_begin; node < level_end; ++node) settle(node, depth);
      level_begin = level_end;
      forest_.depth = std::max(forest_.depth, static_cast<unsigned>(depth));
    }
  }

  [[nodiscard]] const std::vector<TreeItem>& items() const { return items_; }

 private:
  struct Part {
    std::size_t begin, end;
  };

  /// Splits what should and can be split, in two.
  void split(const Part& part, std::vector<Part>& into) {
    const std::size_t count = part.end - part.begin;
    std::size_t first = 0;
    if (count > description_.leaf_size)
      first = split_items(description_.split, std::span(items_).subspan(part.begin, count), description_.leaf_size);
    const bool is_split = first > 0 && first < count;
    if (is_split) into.push_back({part.begin, part.begin + first});
    into.push_back({is_split ? part.begin + first : part.begin, part.end});
  }

  /// Gives the node its children.
  void settle(std::size_t node, std::size_t depth) {
    const std::size_t begin = forest_.nodes[node].first_triangle - first_triangle_;
    std::vector<Part> parts = {{begin, begin + forest_.nodes[node].triangle_count}};
    const std::size_t splits_before = depth * splits_of_a_node_;
    for (std::size_t k = splits_before; k < std::min<std::size_t>(splits_before + splits_of_a_node_, max_depth_); ++k) {
      std::vector<Part> smaller;
      for (const Part& part : parts) split(part, smaller);
      parts = std::move(smaller);
    }
    if (parts.size() < 2) return;
    forest_.nodes[node].first_child = static_cast<std::uint32_t>(forest_.nodes.size());
    forest_.nodes[node].child_count = static_cast<std::uint32_t>(parts.size());
    for (const Part& part : parts)
      forest_.nodes.push_back({.parent = static_cast<std::uint32_t>(node),
                               .first_triangle = first_triangle_ + static_cast<std::uint32_t>(part.begin),
                               .triangle_count = static_cast<std::uint32_t>(part.end - part.begin)});
  }

  Forest& forest_;
  const TreeDescription& description_;
  unsigned splits_of_a_node_;
  std::vector<TreeItem> items_;
  std::uint32_t first_triangle_;
  unsigned max_depth_;
};

void add_tree(Forest& forest, const Model& model, std::uint32_t body, std::span<const glm::vec4> positions,
              const TreeDescription& description) {
  const ModelBody& range = model.bodies[body];
  forest.self_contact.push_back(range.self_contact);
  forest.roots.push_back(range.triangle_count > 0 ? static_cast<std::uint32_t>(forest.nodes.size()) : no_node);
  if (range.triangle_count == 0) return;
  std::vector<TreeItem> items;
  for (std::uint32_t i = 0; i < range.triangle_count; ++i) items.push_back(make_item(model, positions, range.first_triangle + i));
  BodyTree tree(forest, description, std::move(items));
  tree.build();
  for (const TreeItem& item : tree.items()) {
    forest.triangles.push_back(model.triangles[item.triangle]);
    forest.triangle_ids.push_back(item.triangle);
  }
}

}  // namespace

Forest build_forest(const Model& model, std::span<const glm::vec4> positions, const TreeDescription& description) {
  PLIANT_EXPECT(positions.size() == model.rest_positions.size());
  PLIANT_EXPECT(description.leaf_size > 0 && description.max_depth.value_or(1) <= physics::most_splits);
  PLIANT_EXPECT(std::has_single_bit(description.fan_out) && description.fan_out > 1 &&
                description.fan_out <= physics::most_children);
  Forest forest;
  for (std::uint32_t body = 0; body < model.bodies.size(); ++body) add_tree(forest, model, body, positions, description);
  return forest;
}

}  // namespace pliant
