#include "model/deform.hpp"

namespace pliant {

void displace(State& state, const std::function<glm::dvec3(std::size_t vertex)>& by) {
  for (std::size_t vertex = 0; 6 * vertex < state.motion.size(); ++vertex) {
    const glm::dvec3 moved = by(vertex);
    for (std::size_t k = 0; k < 3; ++k) state.motion[6 * vertex + k] += moved[static_cast<glm::length_t>(k)];
  }
}

void swell(const Model& model, State& state, double strain) {
  displace(state, [&](std::size_t vertex) { return strain * glm::dvec3(model.rest_positions[vertex]); });
}

}  // namespace pliant
