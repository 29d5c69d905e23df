#include "model/mean_edge.hpp"

#include <glm/geometric.hpp>

namespace pliant {

double mean_edge(const Model& model, const ModelBody& body) {
  double sum = 0;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (int k = 0; k < 3; ++k)
      sum += glm::length(
          glm::vec3(model.rest_positions[model.triangles[t][k]] - model.rest_positions[model.triangles[t][(k + 1) % 3]]));
  return sum / (3.0 * body.triangle_count);
}

}  // namespace pliant
