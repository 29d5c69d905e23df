#include "collision/trees/tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <span>

#include "mesh/generators.hpp"

namespace pliant::testing {
namespace {

void add_body(Model& model, const TriangleMesh& mesh) {
  ModelBody body;
  body.first_vertex = model.vertex_count();
  body.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  body.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  body.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  for (const glm::dvec3& position : mesh.positions) model.rest_positions.emplace_back(position, 0.0f);
  for (std::array<std::uint32_t, 3> corners : mesh.triangles) {
    for (std::uint32_t& corner : corners) corner += body.first_vertex;
    model.triangles.push_back(corners);
  }
  model.bodies.push_back(body);
}

/// Triangles of all sizes at random places, so that splits come out uneven.
TriangleMesh triangle_soup(std::uint32_t count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double size = std::pow(10.0, -3.0 * unit(engine));
    for (int k = 0; k < 3; ++k) mesh.positions.emplace_back(size * unit(engine), unit(engine) * unit(engine), unit(engine));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

Model three_bodies() {
  Model model;
  add_body(model, generate_mesh("icosphere:2"));
  add_body(model, {{glm::dvec3(0.0), glm::dvec3(1.0)}, {}});  // two vertices, no triangle
  add_body(model, triangle_soup(700));
  return model;
}

Forest build(const Model& model, const TreeDescription& description = {.fan_out = 2}) {
  return build_forest(model, model.rest_positions, description);
}

constexpr std::array all_splits = {TreeSplit::centre, TreeSplit::median, TreeSplit::surface_area};

std::vector<unsigned> depths(const Forest& forest) {
  std::vector<unsigned> depth;
  for (const TreeNode& node : forest.nodes) depth.push_back(node.parent == no_node ? 0 : depth[node.parent] + 1);
  return depth;
}

struct Bounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
};

Bounds bounds(const Model& model, const Forest& forest, const TreeNode& node) {
  Bounds box;
  for (std::uint32_t t = node.first_triangle; t < node.end_of_triangles(); ++t) {
    for (const std::uint32_t vertex : forest.triangles[t]) {
      box.lower = glm::min(box.lower, glm::dvec3(model.rest_positions[vertex]));
      box.upper = glm::max(box.upper, glm::dvec3(model.rest_positions[vertex]));
    }
  }
  return box;
}

double half_surface(const Bounds& box) {
  const glm::dvec3 extent = box.upper - box.lower;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

double centroid(const Model& model, const std::array<std::uint32_t, 3>& corners, int axis) {
  double sum = 0.0;
  for (const std::uint32_t vertex : corners) sum += model.rest_positions[vertex][axis];
  return sum / 3.0;
}

// By the first triangle, which stands in leaf order where the body's triangles do.
const ModelBody& body_of(const Model& model, const TreeNode& node) {
  return *std::ranges::find_if(
      model.bodies, [&](const ModelBody& body) { return node.first_triangle - body.first_triangle < body.triangle_count; });
}

// The first triangle of each leaf.
std::set<std::uint32_t> starts_of_leaves(const Forest& forest) {
  std::set<std::uint32_t> starts;
  for (const TreeNode& node : forest.nodes)
    if (node.is_leaf()) starts.insert(node.first_triangle);
  return starts;
}

}  // namespace

TEST_CASE("every triangle is in exactly one leaf of its own body's tree") {
  const Model model = three_bodies();
  for (const TreeSplit split : all_splits) {
    const Forest forest = build(model, {.split = split, .fan_out = 2});
    std::vector<int> seen(model.triangles.size());
    for (const TreeNode& node : forest.nodes) {
      if (!node.is_leaf()) continue;
      const ModelBody& body = body_of(model, node);
      for (std::uint32_t t = node.first_triangle; t < node.end_of_triangles(); ++t) {
        const std::uint32_t triangle = forest.triangle_ids[t];
        ++seen[triangle];
        CHECK(forest.triangles[t] == model.triangles[triangle]);
        CHECK(triangle - body.first_triangle < body.triangle_count);
      }
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
  }
}

TEST_CASE("children share their parent's triangles out between them and stand next to each other behind it") {
  for (const TreeSplit split : all_splits)
    for (const unsigned fan_out : {2u, 4u, 8u}) {
      const Forest forest = build(three_bodies(), {.split = split, .fan_out = fan_out});
      for (std::uint32_t i = 0; i < forest.nodes.size(); ++i) {
        const TreeNode& node = forest.nodes[i];
        CHECK(node.triangle_count > 0);
        if (node.is_leaf()) continue;
        CHECK((node.first_child > i && node.child_count > 1 && node.child_count <= fan_out));
        std::uint32_t next = node.first_triangle;
        for (std::uint32_t child = node.first_child; child < node.end_of_children(); ++child) {
          CHECK((forest.nodes[child].parent == i && forest.nodes[child].first_triangle == next));
          next = forest.nodes[child].end_of_triangles();
        }
        CHECK(next == node.end_of_triangles());
      }
    }
}

TEST_CASE("leaves are the same for each fan-out, and nodes with many children are fewer and less deep") {
  const Model model = three_bodies();
  for (const TreeSplit split : all_splits)
    for (const std::optional<unsigned> max_depth : {std::optional<unsigned>(), std::optional(5u)}) {
      const Forest binary = build(model, {.split = split, .fan_out = 2, .max_depth = max_depth});
      std::size_t nodes = binary.nodes.size();
      unsigned depth = binary.depth;
      for (const unsigned fan_out : {4u, 8u}) {
        const Forest wide = build(model, {.split = split, .fan_out = fan_out, .max_depth = max_depth});
        CHECK(wide.triangle_ids == binary.triangle_ids);
        CHECK(starts_of_leaves(wide) == starts_of_leaves(binary));
        CHECK((wide.nodes.size() < nodes && wide.depth < depth));
        nodes = wide.nodes.size();
        depth = wide.depth;
      }
    }
}

TEST_CASE("a split separates centroids about the centre of the longest axis of the node's box") {
  const Model model = three_bodies();
  const Forest forest = build(model, {.split = TreeSplit::centre, .fan_out = 2});
  for (const TreeNode& node : forest.nodes) {
    if (node.is_leaf()) continue;
    const Bounds box = bounds(model, forest, node);
    const glm::dvec3 extent = box.upper - box.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const double centre = 0.5 * (box.lower[axis] + box.upper[axis]);
    const std::uint32_t middle = forest.nodes[node.first_child].end_of_triangles();
    for (std::uint32_t t = node.first_triangle; t < node.end_of_triangles(); ++t) {
      const double distance = centroid(model, forest.triangles[t], axis) - centre;
      CHECK((t < middle ? distance <= 1e-12 : distance >= -1e-12));
    }
  }
}

// Triangles of a node, as places in the forest's order.
std::vector<std::uint32_t> triangles_of(const TreeNode& node) {
  std::vector<std::uint32_t> triangles(node.triangle_count);
  std::iota(triangles.begin(), triangles.end(), node.first_triangle);
  return triangles;
}

Bounds bounds(const Model& model, const Forest& forest, std::span<const std::uint32_t> triangles) {
  Bounds box;
  for (const std::uint32_t t : triangles) {
    const Bounds one = bounds(model, forest, TreeNode{.first_triangle = t, .triangle_count = 1});
    box.lower = glm::min(box.lower, one.lower);
    box.upper = glm::max(box.upper, one.upper);
  }
  return box;
}

TEST_CASE("a split at the median leaves halves that fill whole leaves, along the axis of least surface") {
  const Model model = three_bodies();
  for (const unsigned leaf_size : {1u, 4u, 7u}) {
    const Forest forest = build(model, {.split = TreeSplit::median, .fan_out = 2, .leaf_size = leaf_size});
    for (const TreeNode& node : forest.nodes) {
      CHECK(node.is_leaf() == (node.triangle_count <= leaf_size));
      if (node.is_leaf()) continue;
      const TreeNode left = forest.nodes[node.first_child], right = forest.nodes[node.first_child + 1];
      CHECK(left.triangle_count % leaf_size == 0);
      CHECK(std::max(left.triangle_count, right.triangle_count) - std::min(left.triangle_count, right.triangle_count) <=
            leaf_size);
      const double surface = half_surface(bounds(model, forest, left)) + half_surface(bounds(model, forest, right));
      double least = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<std::uint32_t> sorted = triangles_of(node);
        std::ranges::sort(sorted, {}, [&](std::uint32_t t) {
          return std::pair(centroid(model, forest.triangles[t], axis), forest.triangle_ids[t]);
        });
        const std::span all(sorted);
        least = std::min(least, half_surface(bounds(model, forest, all.first(left.triangle_count))) +
                                    half_surface(bounds(model, forest, all.subspan(left.triangle_count))));
      }
      CHECK(surface <= least * (1 + 1e-9));
    }
  }
}

TEST_CASE("a split by surface area is the best of the places on the three axes") {
  constexpr int places = 15;
  Model model;
  add_body(model, triangle_soup(700));
  const Forest forest = build(model, {.split = TreeSplit::surface_area, .fan_out = 2});
  const auto cost = [&](std::span<const std::uint32_t> triangles) {
    return half_surface(bounds(model, forest, triangles)) * static_cast<double>(triangles.size());
  };
  for (const TreeNode& node : forest.nodes) {
    if (node.is_leaf()) continue;
    const double taken =
        cost(triangles_of(forest.nodes[node.first_child])) + cost(triangles_of(forest.nodes[node.first_child + 1]));
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](std::uint32_t t) { return centroid(model, forest.triangles[t], axis); };
      std::vector<std::uint32_t> all = triangles_of(node);
      std::ranges::sort(all, {}, at);
      const double lower = at(all.front()), upper = at(all.back());
      for (int k = 1; k <= places; ++k) {
        const double place = lower + (upper - lower) * k / (places + 1);
        const auto middle = std::ranges::lower_bound(all, place, {}, at);
        if (middle == all.begin() || middle == all.end()) continue;
        least = std::min(least, cost({all.begin(), middle}) + cost({middle, all.end()}));
      }
    }
    CHECK(taken == Approx(least).epsilon(1e-9));
  }
}

TEST_CASE("a tree's nodes are contiguous, level by level") {
  const Model model = three_bodies();
  for (const unsigned fan_out : {2u, 4u, 8u}) {
    const Forest forest = build(model, {.fan_out = fan_out});
    const std::vector<unsigned> depth = depths(forest);
    const std::uint32_t last_root = forest.roots[2];
    CHECK(std::is_sorted(depth.begin(), depth.begin() + last_root));
    CHECK(std::is_sorted(depth.begin() + last_root, depth.end()));
    CHECK(*std::max_element(depth.begin(), depth.end()) == forest.depth);
  }
}

TEST_CASE("roots have each body's triangles, and a body without any has none") {
  const Model model = three_bodies();
  const Forest forest = build(model);
  REQUIRE(forest.roots.size() == 3);
  CHECK(forest.roots[0] == 0);
  CHECK(forest.roots[1] == no_node);
  CHECK(forest.nodes[forest.roots[2]].parent == no_node);
  CHECK(forest.nodes[forest.roots[2]].triangle_count == model.bodies[2].triangle_count);
}

TEST_CASE("max_depth limits a tree, whatever its leaves then hold") {
  const Model model = three_bodies();
  TreeDescription description{.fan_out = 2};
  for (const unsigned limit : {1u, 3u, 6u}) {
    description.max_depth = limit;
    const Forest forest = build(model, description);
    CHECK(forest.depth == limit);
  }
}

TEST_CASE("leaf_size says when a node is small enough, and larger nodes split") {
  const Model model = three_bodies();
  TreeDescription description{.fan_out = 2};
  description.max_depth = 64;
  for (const unsigned leaf_size : {1u, 4u, 32u}) {
    description.leaf_size = leaf_size;
    const Forest forest = build(model, description);
    for (std::uint32_t n = 0; n < forest.nodes.size(); ++n) {
      const TreeNode& node = forest.nodes[n];
      CHECK((node.is_leaf() || node.triangle_count > leaf_size));
      if (node.is_leaf() && n < forest.roots[2]) CHECK(node.triangle_count <= leaf_size);
    }
  }
}

TEST_CASE("triangles with one common centroid stay in one leaf") {
  Model model;
  TriangleMesh stack;
  stack.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  stack.triangles.assign(20, {0, 1, 2});
  add_body(model, stack);
  for (const TreeSplit split : all_splits) {
    const Forest forest = build(model, {.split = split, .fan_out = 2});
    CHECK(forest.nodes.size() == 1);
    CHECK(forest.nodes.front().is_leaf());
  }
}

TEST_CASE("by default the depth follows the triangle count, so that leaves of a sphere fill up to leaf_size") {
  for (const char* mesh : {"icosphere:1", "icosphere:3", "icosphere:5"}) {
    Model model;
    add_body(model, generate_mesh(mesh));
    const Forest forest = build(model);
    for (const TreeNode& node : forest.nodes)
      if (node.is_leaf()) CHECK(node.triangle_count <= 4);
    CHECK(starts_of_leaves(forest).size() < model.triangles.size() / 2);
  }
}

TEST_CASE("a body's tree does not depend on the other bodies") {
  const Model model = three_bodies();
  Model alone;
  add_body(alone, triangle_soup(700));
  const std::uint32_t offset = model.bodies[2].first_triangle;
  for (const TreeSplit split : all_splits) {
    const Forest all = build(model, {.split = split, .fan_out = 2}), single = build(alone, {.split = split, .fan_out = 2});
    REQUIRE(single.nodes.size() == all.nodes.size() - all.roots[2]);
    for (std::size_t i = 0; i < single.nodes.size(); ++i) {
      const TreeNode& one = single.nodes[i];
      const TreeNode& other = all.nodes[all.roots[2] + i];
      CHECK((one.first_triangle + offset == other.first_triangle && one.triangle_count == other.triangle_count));
    }
    for (std::size_t t = 0; t < single.triangles.size(); ++t)
      CHECK(single.triangle_ids[t] + offset == all.triangle_ids[offset + t]);
  }
}

}  // namespace pliant::testing
