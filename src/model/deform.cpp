#include "model/deform.hpp"

namespace pliant {

void displace(State& state, const std::function<glm::dvec3(std::size_t vertex)>& by) {
  const std::size_t vertex_count = state.motion.size() / physics::motion_size;
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    const glm::dvec3 moved = state.displacement(vertex) + by(vertex);
    STORE3(state.motion, physics::displacement_of(static_cast<std::uint32_t>(vertex)), moved)
  }
}

void swell(const Model& model, State& state, double strain) {
  displace(state, [&](std::size_t vertex) { return strain * glm::dvec3(model.rest_positions[vertex]); });
}

}  // namespace pliant
