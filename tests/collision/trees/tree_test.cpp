#include "collision/trees/tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
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

Forest build(const Model& model, const TreeDescription& description = {}) {
  return build_forest(model, model.rest_positions, description);
}

constexpr std::array all_splits = {TreeSplit::centre, TreeSplit::median, TreeSplit::surface_area};

bool is_leaf(const glm::uvec4& node) { return node.x == 0; }
unsigned size(const glm::uvec4& node) { return node.w - node.z; }

std::vector<unsigned> depths(const Forest& forest) {
  std::vector<unsigned> depth;
  for (const glm::uvec4& node : forest.nodes) depth.push_back(node.y == no_node ? 0 : depth[node.y] + 1);
  return depth;
}

struct Bounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
};

Bounds bounds(const Model& model, const Forest& forest, const glm::uvec4& node) {
  Bounds box;
  for (std::uint32_t t = node.z; t < node.w; ++t) {
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

}  // namespace

TEST_CASE("every triangle is in exactly one leaf of its own body's tree") {
  const Model model = three_bodies();
  for (const TreeSplit split : all_splits) {
    const Forest forest = build(model, {.split = split});
    std::vector<int> seen(model.triangles.size());
    for (const glm::uvec2& leaf : forest.leaves) {
      const glm::uvec4 node = forest.nodes[leaf.x];
      REQUIRE(is_leaf(node));
      const ModelBody& body = model.bodies[leaf.y];
      for (std::uint32_t t = node.z; t < node.w; ++t) {
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
  for (const TreeSplit split : all_splits) {
    const Forest forest = build(three_bodies(), {.split = split});
    for (std::uint32_t i = 0; i < forest.nodes.size(); ++i) {
      const glm::uvec4 node = forest.nodes[i];
      CHECK(size(node) > 0);
      if (is_leaf(node)) continue;
      REQUIRE(node.x > i);
      const glm::uvec4 left = forest.nodes[node.x], right = forest.nodes[node.x + 1];
      CHECK((left.y == i && right.y == i));
      CHECK((left.z == node.z && left.w == right.z && right.w == node.w));
      CHECK((size(left) > 0 && size(right) > 0));
    }
  }
}

TEST_CASE("a split separates centroids about the centre of the longest axis of the node's box") {
  const Model model = three_bodies();
  const Forest forest = build(model);
  for (const glm::uvec4& node : forest.nodes) {
    if (is_leaf(node)) continue;
    const Bounds box = bounds(model, forest, node);
    const glm::dvec3 extent = box.upper - box.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const double centre = 0.5 * (box.lower[axis] + box.upper[axis]);
    const std::uint32_t middle = forest.nodes[node.x].w;
    for (std::uint32_t t = node.z; t < node.w; ++t) {
      const double distance = centroid(model, forest.triangles[t], axis) - centre;
      CHECK((t < middle ? distance <= 1e-12 : distance >= -1e-12));
    }
  }
}

// Triangles of a node, as places in the forest's order.
std::vector<std::uint32_t> triangles_of(const glm::uvec4& node) {
  std::vector<std::uint32_t> triangles(size(node));
  std::iota(triangles.begin(), triangles.end(), node.z);
  return triangles;
}

Bounds bounds(const Model& model, const Forest& forest, std::span<const std::uint32_t> triangles) {
  Bounds box;
  for (const std::uint32_t t : triangles) {
    const Bounds one = bounds(model, forest, glm::uvec4(0, 0, t, t + 1));
    box.lower = glm::min(box.lower, one.lower);
    box.upper = glm::max(box.upper, one.upper);
  }
  return box;
}

TEST_CASE("a split at the median leaves halves that fill whole leaves, along the axis of least surface") {
  const Model model = three_bodies();
  for (const unsigned leaf_size : {1u, 4u, 7u}) {
    const Forest forest = build(model, {.split = TreeSplit::median, .leaf_size = leaf_size});
    for (const glm::uvec4& node : forest.nodes) {
      CHECK(is_leaf(node) == (size(node) <= leaf_size));
      if (is_leaf(node)) continue;
      const glm::uvec4 left = forest.nodes[node.x], right = forest.nodes[node.x + 1];
      CHECK(size(left) % leaf_size == 0);
      CHECK(std::max(size(left), size(right)) - std::min(size(left), size(right)) <= leaf_size);
      const double surface = half_surface(bounds(model, forest, left)) + half_surface(bounds(model, forest, right));
      double least = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<std::uint32_t> sorted = triangles_of(node);
        std::ranges::sort(sorted, {}, [&](std::uint32_t t) {
          return std::pair(centroid(model, forest.triangles[t], axis), forest.triangle_ids[t]);
        });
        const std::span all(sorted);
        least = std::min(least, half_surface(bounds(model, forest, all.first(size(left)))) +
                                    half_surface(bounds(model, forest, all.subspan(size(left)))));
      }
      CHECK(surface <= least * (1 + 1e-9));
    }
  }
}

TEST_CASE("a split by surface area is the best of the places on the three axes") {
  constexpr int places = 15;
  Model model;
  add_body(model, triangle_soup(700));
  const Forest forest = build(model, {.split = TreeSplit::surface_area});
  const auto cost = [&](std::span<const std::uint32_t> triangles) {
    return half_surface(bounds(model, forest, triangles)) * static_cast<double>(triangles.size());
  };
  for (const glm::uvec4& node : forest.nodes) {
    if (is_leaf(node)) continue;
    const double taken = cost(triangles_of(forest.nodes[node.x])) + cost(triangles_of(forest.nodes[node.x + 1]));
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

TEST_CASE("a tree's nodes are contiguous, level by level, and its leaves are listed in their order") {
  const Model model = three_bodies();
  const Forest forest = build(model);
  const std::vector<unsigned> depth = depths(forest);
  const std::uint32_t last_root = forest.roots[2];
  CHECK(std::is_sorted(depth.begin(), depth.begin() + last_root));
  CHECK(std::is_sorted(depth.begin() + last_root, depth.end()));
  CHECK(*std::max_element(depth.begin(), depth.end()) == forest.depth);
  std::vector<glm::uvec2> leaves;
  for (std::uint32_t i = 0; i < forest.nodes.size(); ++i) {
    if (is_leaf(forest.nodes[i])) leaves.emplace_back(i, i < last_root ? 0 : 2);
  }
  CHECK(forest.leaves == leaves);
}

TEST_CASE("roots and leaf counts describe each body, also one without triangles") {
  const Model model = three_bodies();
  const Forest forest = build(model);
  REQUIRE(forest.roots.size() == 3);
  CHECK(forest.roots[0] == 0);
  CHECK(forest.roots[1] == no_node);
  CHECK(forest.nodes[forest.roots[2]].y == no_node);
  CHECK(size(forest.nodes[forest.roots[2]]) == model.bodies[2].triangle_count);
  CHECK(forest.leaf_counts[1] == 0);
  CHECK(forest.leaf_counts[0] + forest.leaf_counts[2] == forest.leaves.size());
}

TEST_CASE("max_depth limits a tree, whatever its leaves then hold") {
  const Model model = three_bodies();
  TreeDescription description;
  for (const unsigned limit : {1u, 3u, 6u}) {
    description.max_depth = limit;
    const Forest forest = build(model, description);
    CHECK(forest.depth == limit);
  }
}

TEST_CASE("leaf_size says when a node is small enough, and larger nodes split") {
  const Model model = three_bodies();
  TreeDescription description;
  description.max_depth = 64;
  for (const unsigned leaf_size : {1u, 4u, 32u}) {
    description.leaf_size = leaf_size;
    const Forest forest = build(model, description);
    for (const glm::uvec4& node : forest.nodes) CHECK((is_leaf(node) || size(node) > leaf_size));
    for (std::uint32_t i = 0; i < forest.leaf_counts[0]; ++i) CHECK(size(forest.nodes[forest.leaves[i].x]) <= leaf_size);
  }
}

TEST_CASE("triangles with one common centroid stay in one leaf") {
  Model model;
  TriangleMesh stack;
  stack.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  stack.triangles.assign(20, {0, 1, 2});
  add_body(model, stack);
  for (const TreeSplit split : all_splits) {
    const Forest forest = build(model, {.split = split});
    CHECK(forest.nodes.size() == 1);
    CHECK(forest.leaves == std::vector{glm::uvec2(0, 0)});
  }
}

TEST_CASE("by default the depth follows the triangle count, so that leaves of a sphere fill up to leaf_size") {
  for (const char* mesh : {"icosphere:1", "icosphere:3", "icosphere:5"}) {
    Model model;
    add_body(model, generate_mesh(mesh));
    const Forest forest = build(model);
    unsigned largest = 0;
    for (const glm::uvec2& leaf : forest.leaves) largest = std::max(largest, size(forest.nodes[leaf.x]));
    CHECK(largest <= 4);
    CHECK(forest.leaves.size() < model.triangles.size() / 2);
  }
}

TEST_CASE("a search starts from the highest nodes of a body that are small enough, which share its triangles out between them") {
  const Model model = three_bodies();
  const Forest forest = build(model);
  for (const std::uint32_t most : {1u, 3u, 20u, 300u, 320u, 700u, 5000u})
    for (std::uint32_t body = 0; body < model.bodies.size(); ++body) {
      CAPTURE(most, body);
      const std::vector<std::uint32_t> starts = start_nodes(forest, body, most);
      std::vector<int> seen(model.triangles.size());
      for (const std::uint32_t start : starts) {
        const glm::uvec4 node = forest.nodes[start];
        CHECK((size(node) <= most || is_leaf(node)));
        if (node.y != no_node) CHECK(size(forest.nodes[node.y]) > most);
        for (std::uint32_t t = node.z; t < node.w; ++t) ++seen[forest.triangle_ids[t]];
      }
      const ModelBody& range = model.bodies[body];
      for (std::uint32_t t = 0; t < seen.size(); ++t) {
        const bool is_own = t >= range.first_triangle && t < range.first_triangle + range.triangle_count;
        CHECK(seen[t] == (is_own ? 1 : 0));
      }
      CHECK(starts.empty() == (range.triangle_count == 0));
    }
}

TEST_CASE("a body's tree does not depend on the other bodies") {
  const Model model = three_bodies();
  Model alone;
  add_body(alone, triangle_soup(700));
  const std::uint32_t offset = model.bodies[2].first_triangle;
  for (const TreeSplit split : all_splits) {
    const Forest all = build(model, {.split = split}), single = build(alone, {.split = split});
    REQUIRE(single.nodes.size() == all.nodes.size() - all.roots[2]);
    for (std::size_t i = 0; i < single.nodes.size(); ++i) {
      CHECK(single.nodes[i].z + offset == all.nodes[all.roots[2] + i].z);
      CHECK(single.nodes[i].w + offset == all.nodes[all.roots[2] + i].w);
    }
    for (std::size_t t = 0; t < single.triangles.size(); ++t)
      CHECK(single.triangle_ids[t] + offset == all.triangle_ids[offset + t]);
  }
}

}  // namespace pliant::testing
