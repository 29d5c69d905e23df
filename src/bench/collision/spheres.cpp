#include "bench/collision/spheres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "mesh/generators.hpp"
#include "model/deform.hpp"
#include "model/mean_edge.hpp"

namespace pliant::bench {

ModelAndState spheres(std::size_t count, int level, const glm::dvec3& apart) {
  std::vector<BodySetup> setups(count);
  for (std::size_t k = 0; k < count; ++k) {
    setups[k].mesh = generate_mesh(fmt::format("icosphere:{}", level));
    setups[k].description.name = fmt::format("sphere {}", k + 1);
    setups[k].description.rotation = k % 2 == 0 ? glm::dvec3(10, 20, 30) : glm::dvec3(40, 15, 70);  // no edge lies along an axis
    setups[k].description.position = static_cast<double>(k) * apart;
  }
  return build_model(setups, glm::dvec3(0.0));
}

ModelAndState pressed_spheres(int level) {
  constexpr double apart = 1.9;
  ModelAndState start = spheres(2, level, {apart, 0, 0});
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
