#include "model/deform.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "support/evolve.hpp"

namespace pliant {
namespace {

TEST_CASE("a swollen body is its rest shape, larger about its centroid, and as fast as before") {
  BodySetup setup = sphere(1);
  setup.description.position = {1, 2, 3};
  setup.description.rotation = {20, 30, 40};
  setup.description.spin = {1, 0, 2};
  const ModelAndState before = built(setup);
  State state = before.state;
  swell(before.model, state, 0.25);
  const auto from = before.state.world_positions(before.model), to = state.world_positions(before.model);
  for (std::size_t i = 0; i < from.size(); ++i)
    CHECK(glm::distance(to[i] - setup.description.position, 1.25 * (from[i] - setup.description.position)) < 1e-6);
  CHECK(state.world_velocities(before.model) == before.state.world_velocities(before.model));
}

TEST_CASE("vertices are displaced on top of what they were") {
  State state = built(two_vertices()).state;
  for (int times = 0; times < 2; ++times)
    displace(state, [](std::size_t vertex) { return glm::dvec3(0.5, 0, static_cast<double>(vertex)); });
  CHECK(state.motion == std::vector<double>{1, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0});
}

}  // namespace
}  // namespace pliant
