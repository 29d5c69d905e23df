#include "bench/collision/two_spheres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "mesh/generators.hpp"
#include "model/deform.hpp"
#include "model/mean_edge.hpp"

namespace pliant::bench {

ModelAndState two_spheres(int level, const glm::dvec3& apart) {
  std::vector<BodySetup> setups(2);
  for (BodySetup& setup : setups) {
    setup.mesh = generate_mesh(fmt::format("icosphere:{}", level));
    setup.description.rotation = {10, 20, 30};  // no edge lies along an axis
  }
  setups[0].description.name = "first";
  setups[1].description.name = "second";
  setups[1].description.rotation = {40, 15, 70};
  setups[1].description.position = apart;
  return build_model(setups, glm::dvec3(0.0));
}

ModelAndState pressed_spheres(int level) {
  constexpr double apart = 1.9;
  ModelAndState start = two_spheres(level, {apart, 0, 0});
  const Model& model = start.model;
  const double quarter_gap = CollisionDescription().gap / 4 * mean_edge(model, model.bodies.front());
  const std::vector<glm::dvec3> places = start.state.world_positions(model);
  displace(start.state, [&](std::size_t vertex) {
    const std::uint32_t body = model.body_index(vertex);
    const double x = places[vertex].x, wall = apart / 2 + (body == 0 ? -quarter_gap : quarter_gap);
    const double pressed = body == 0 ? std::min(x, wall) : std::max(x, wall);
    return physics::rotate_back(start.state.poses[body], {pressed - x, 0, 0});
  });
  return start;
}

}  // namespace pliant::bench
