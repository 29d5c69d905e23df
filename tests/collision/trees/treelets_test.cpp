#include "collision/trees/treelets.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <span>
#include <vector>

#include "mesh/generators.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// Two spheres, and a body without triangles between them.
Model spheres() {
  BodySetup points = sphere(0);
  points.mesh.triangles.clear();
  return build_model(std::vector{sphere(2), points, sphere(3)}, {0, 0, 0}).model;
}

struct Cut {
  Forest forest;
  Treelets cut;
};

Cut cut_spheres(unsigned fan_out, std::uint32_t most_triangles) {
  const Model model = spheres();
  Forest forest = build_forest(model, model.rest_positions, {.fan_out = fan_out});
  Treelets treelets = cut_into_treelets(forest, most_triangles);
  return {std::move(forest), std::move(treelets)};
}

TEST_CASE("treelets are the highest nodes that are small enough, and share a body's triangles out between them") {
  for (const unsigned fan_out : {2u, 4u, 8u})
    for (const std::uint32_t most : {1u, 3u, 20u, 300u, 320u, 1280u, 5000u}) {
      CAPTURE(fan_out, most);
      const auto [forest, cut] = cut_spheres(fan_out, most);
      REQUIRE(cut.trees.size() == 3);
      std::uint32_t next_treelet = 0;
      for (std::uint32_t body = 0; body < 3; ++body) {
        const glm::uvec4 tree = cut.trees[body];
        CHECK(tree.x == next_treelet);
        next_treelet += tree.y;
        std::uint32_t next_triangle = tree.z;
        for (std::uint32_t t = tree.x; t < tree.x + tree.y; ++t) {
          const physics::Treelet& treelet = cut.treelets[t];
          CHECK(treelet.body == body);
          const TreeNode& root = forest.nodes[cut.in_forest[treelet.first_node]];
          CHECK((root.triangle_count <= most || root.is_leaf()));
          if (root.parent != no_node) CHECK(forest.nodes[root.parent].triangle_count > most);
          CHECK(root.first_triangle == next_triangle);
          next_triangle = root.end_of_triangles();
        }
        CHECK(next_triangle == tree.w);
      }
      CHECK(next_treelet == cut.treelets.size());
      CHECK(cut.trees[1].y == 0);
    }
}

TEST_CASE("a treelet has all nodes below its root, level by level, with the triangles that they have in the forest") {
  for (const unsigned fan_out : {2u, 4u, 8u}) {
    CAPTURE(fan_out);
    const auto [forest, cut] = cut_spheres(fan_out, 100);
    std::uint32_t next_node = 0;
    for (const physics::Treelet& treelet : cut.treelets) {
      CHECK(treelet.first_node == next_node);
      std::vector<std::uint32_t> level(treelet.end_node - treelet.first_node, 0);
      std::uint32_t next_child = treelet.first_node + 1;
      for (std::uint32_t n = treelet.first_node; n < treelet.end_node; ++n) {
        const glm::uvec4 node = cut.nodes[n];
        const TreeNode& in_forest = forest.nodes[cut.in_forest[n]];
        CHECK(node.y - node.x == in_forest.child_count);
        CHECK((node.x == 0) == in_forest.is_leaf());
        if (in_forest.is_leaf()) CHECK((node.z == in_forest.first_triangle && node.w == in_forest.end_of_triangles()));
        if (!in_forest.is_leaf()) CHECK(n < treelet.end_inner);
        std::uint32_t height = 0;
        for (std::uint32_t child = node.x; child < node.y; ++child) {
          CHECK(child == next_child++);
          CHECK(forest.nodes[cut.in_forest[child]].parent == cut.in_forest[n]);
          level[child - treelet.first_node] = level[n - treelet.first_node] + 1;
          height = std::max(height, cut.nodes[child].x == 0 ? 1 : cut.nodes[child].z + 1);
        }
        if (!in_forest.is_leaf()) CHECK(node.z == height);
      }
      CHECK(next_child == treelet.end_node);
      CHECK((treelet.end_inner == treelet.first_node || cut.nodes[treelet.end_inner - 1].x != 0));
      CHECK(std::ranges::is_sorted(level));
      CHECK(level.back() + 1 == treelet.levels);
      next_node = treelet.end_node;
    }
    CHECK(next_node == cut.nodes.size());
  }
}

TEST_CASE("a treelet has the vertices of its triangles, each once") {
  const auto [forest, cut] = cut_spheres(8, 100);
  for (const physics::Treelet& treelet : cut.treelets) {
    const TreeNode& root = forest.nodes[cut.in_forest[treelet.first_node]];
    std::set<std::uint32_t> vertices;
    for (std::uint32_t t = root.first_triangle; t < root.end_of_triangles(); ++t)
      vertices.insert(forest.triangles[t].begin(), forest.triangles[t].end());
    const std::span found = std::span(cut.vertices).subspan(treelet.first_vertex, treelet.end_vertex - treelet.first_vertex);
    CHECK(std::ranges::equal(found, vertices));
  }
}

// All children overlap, in the deepest trees there are.
TEST_CASE("a group never has more pairs of nodes open than it has room for") {
  constexpr std::uint32_t openings = 2 * 22;
  for (const std::uint32_t threads : {1u, 64u})
    for (const std::uint32_t first : {1u, 2u, 63u, 64u}) {
      CAPTURE(threads, first);
      std::vector<std::uint32_t> open(first, openings);  // how often each pair can be opened
      std::size_t most = open.size();
      for (int round = 0; round < 20000 && !open.empty(); ++round) {
        const std::uint32_t taken = physics::pairs_to_open(static_cast<std::uint32_t>(open.size()), threads);
        REQUIRE((taken > 0 && taken <= open.size() && taken <= threads));
        const std::vector<std::uint32_t> latest(open.end() - taken, open.end());
        open.resize(open.size() - taken);
        for (const std::uint32_t left : latest)
          if (left > 1) open.insert(open.end(), physics::most_children, left - 1);
        most = std::max(most, open.size());
      }
      CHECK(most <= physics::most_open_pairs);
      if (threads == 64) CHECK(most > physics::most_open_pairs / 2);
    }
}

}  // namespace
}  // namespace pliant
