#include "collision/trees/tree_search.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "support/collision_scene.hpp"
#include "support/device_bench.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

TEST_CASE("boxes of trees are the same bits on CPU and GPU, and bound their triangles", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const Method method{"rk4", 0.01};
  std::vector<std::unique_ptr<Bench>> benches;
  benches.push_back(std::make_unique<Bench>(make_cpu_device(3, 32), start, method, CollisionDescription{}));
  if (test::has_gl()) benches.push_back(std::make_unique<Bench>(make_gpu_device(0), start, method, CollisionDescription{}));
  // The same world positions everywhere, close enough for the trees to be refitted.
  std::vector<glm::vec4> positions;
  for (const glm::dvec3& p : start.state.world_positions(start.model)) positions.emplace_back(glm::vec3(p), 1.0f);
  for (std::size_t i = start.model.bodies[1].first_vertex; i < positions.size(); ++i) positions[i].x -= 0.3f;
  for (const auto& bench : benches) {
    bench->bodies.world_positions.upload(positions, positions.size());
    for (const auto& passes : {std::vector{bench->collider.bounding_pass(1)}, bench->collider.search_passes(1)})
      bench->device->run(passes);
    const Forest& forest = bench->collider.forest();
    const auto boxes = bench->collider.trees().node_boxes();
    std::size_t wrong = 0, kept = 0;
    for (std::size_t n = 0; n < forest.nodes.size(); ++n) {
      if (!is_kept(forest.nodes[n], bench->collider.trees().triangles_of_a_treelet())) continue;
      ++kept;
      glm::vec3 lower(1e30f), upper(-1e30f);
      for (std::uint32_t t = forest.nodes[n].first_triangle; t < forest.nodes[n].end_of_triangles(); ++t)
        for (const std::uint32_t vertex : forest.triangles[t]) {
          lower = glm::min(lower, glm::vec3(positions[vertex]));
          upper = glm::max(upper, glm::vec3(positions[vertex]));
        }
      if (glm::vec3(boxes[2 * n]) != lower || glm::vec3(boxes[2 * n + 1]) != upper) ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(bench->bodies.control.download().front().count[physics::nodes_refitted] == kept);
  }
}

}  // namespace
}  // namespace pliant
