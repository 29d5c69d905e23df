#include "simulation/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/error.hpp"

namespace pliant {
namespace {

const char* const way_apart = "move them apart, or write response = \"reflect\" in [collision], which lets bodies begin tangled";

// How deep the body's deepest vertex stands in the ground [m], or below 0 if none does.
double depth_in(const Ground& ground, const ModelBody& body, std::span<const glm::dvec3> positions) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : positions.subspan(body.first_vertex, body.vertex_count))
    deepest = std::max(deepest, ground.offset - glm::dot(ground.normal, p));
  return deepest;
}

void expect_above_grounds(const Model& model, const State& state, const std::string& place) {
  const std::vector<glm::dvec3> positions = state.world_positions(model);
  for (const ModelBody& body : model.bodies)
    for (const Ground& ground : model.grounds)
      if (const double depth = depth_in(ground, body, positions); !body.is_static && depth >= 0)
        throw Error(ErrorKind::input, place,
                    depth == 0 ? fmt::format("body \"{}\" touches a ground", body.name)
                               : fmt::format("body \"{}\" stands {:.4g} m deep in a ground", body.name, depth),
                    "leave a small distance between them, as of a twentieth of an edge");
}

}  // namespace

std::string told_overlap(Simulation& simulation, const Model& model) {
  constexpr std::size_t most_names = 8;
  const Intersections overlap = simulation.intersections();
  if (overlap.pairs == 0) return "";
  std::string names;
  for (const std::uint32_t body : std::span(overlap.bodies).first(std::min(most_names, overlap.bodies.size())))
    names += (names.empty() ? "" : ", ") + model.bodies[body].name;
  if (overlap.bodies.size() > most_names) names += fmt::format(" and {} more", overlap.bodies.size() - most_names);
  return fmt::format("these bodies intersect at the start ({} triangle pairs): {}", overlap.pairs, names);
}

bool keeps_apart(const Simulation& simulation) {
  const Response* const response = simulation.collider().response();
  return response != nullptr && response->keeps_apart();
}

void expect_apart(Simulation& simulation, const Model& model, const std::string& place) {
  if (!keeps_apart(simulation)) return;
  expect_above_grounds(model, simulation.state(), place);
  if (const std::string overlap = told_overlap(simulation, model); !overlap.empty())
    throw Error(ErrorKind::input, place, overlap, way_apart);
}

}  // namespace pliant
