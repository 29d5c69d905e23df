#include "simulation/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/error.hpp"
#include "simulation/overlap.hpp"

namespace pliant {
namespace {

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
        throw Error(
            ErrorKind::input, place,
            depth == 0 ? fmt::format("body \"{}\" touches a ground", body.name)
                       : fmt::format("body \"{}\" stands {:.4g} m deep in a ground", body.name, depth),
            fmt::format("raise the body by {:.4g} m, which leaves a twentieth of an edge between them, or lower the ground",
                        depth + usual_gap(model, body)));
}

std::string described(const Model& model, const Overlap& overlap) {
  const std::string names =
      fmt::format("bodies \"{}\" and \"{}\" intersect", model.bodies[overlap.first].name, model.bodies[overlap.second].name);
  return overlap.depth > 0 ? fmt::format("{}, at least {:.3g} m deep", names, overlap.depth)
                           : fmt::format("{}, less deep than an edge is long", names);
}

std::string way_apart(const Model& model, const Overlap& overlap) {
  const bool moves_first = model.bodies[overlap.second].is_static;
  const ModelBody& body = model.bodies[moves_first ? overlap.first : overlap.second];
  const glm::dvec3 way = (moves_first ? -1.0 : 1.0) * overlap.way_out;
  const bool may_reflect = model.grounds.empty() && std::ranges::none_of(model.bodies, &ModelBody::is_static);
  return fmt::format("move them apart, such as \"{}\" by [{:.4g}, {:.4g}, {:.4g}], or {}", body.name, way.x, way.y, way.z,
                     may_reflect ? "write response = \"reflect\" in [collision], which lets bodies begin tangled"
                                 : "give one of them a smaller scale");
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
  const Intersections found = simulation.intersections();
  if (found.pairs == 0) return;
  const Overlap overlap = find_overlap(model, simulation.state().world_positions(model), found.bodies);
  throw Error(ErrorKind::input, place, described(model, overlap), way_apart(model, overlap));
}

}  // namespace pliant
