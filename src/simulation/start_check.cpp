#include "simulation/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "collision/responses/impulse.hpp"
#include "core/error.hpp"
#include "simulation/overlap.hpp"

namespace pliant {
namespace {

enum class Nearness { provable, any };  // how near each other bodies may be that do not intersect

// How deep the body's deepest vertex stands in the ground [m], or below 0 if none does.
double depth_in(const Ground& ground, const ModelBody& body, std::span<const glm::dvec3> positions) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : positions.subspan(body.first_vertex, body.vertex_count))
    deepest = std::max(deepest, ground.offset - glm::dot(ground.normal, p));
  return deepest;
}

// Grounds that the body touches or stands in.
std::vector<const Ground*> grounds_under(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  std::vector<const Ground*> found;
  for (const Ground& ground : model.grounds)
    if (!body.is_rigid() && depth_in(ground, body, positions) >= 0) found.push_back(&ground);
  return found;
}

// Says how deep the body stands in each of these grounds. The error's place is that of the first one.
std::string described(std::span<const Ground* const> grounds, const ModelBody& body, std::span<const glm::dvec3> positions) {
  std::string text = fmt::format("body \"{}\" ", body.name);
  for (const Ground* ground : grounds) {
    const double depth = depth_in(*ground, body, positions);
    if (ground != grounds.front()) text += ", and ";
    text += depth == 0 ? "touches " : fmt::format("stands {:.4g} m deep in ", depth);
    text += ground == grounds.front() ? "this ground" : fmt::format("that of {}", ground->where.place);
  }
  return text;
}

// A message with "-0" would look like a mistake.
glm::dvec3 without_signs_of_zeros(const glm::dvec3& v) { return v + 0.0; }

// A move out of one ground can lead into another. No move is named then.
std::string way_out_of(std::span<const Ground* const> grounds, const Model& model, const ModelBody& body,
                       std::span<const glm::dvec3> positions, const CollisionDescription& collision) {
  const Ground& ground = *grounds.front();
  const double gap = physics::gap_above(ground_of(ground, collision), surface_of(model, body, collision));
  const glm::dvec3 way = without_signs_of_zeros((depth_in(ground, body, positions) + gap) * ground.normal);
  std::vector<glm::dvec3> moved(positions.begin(), positions.end());
  for (glm::dvec3& position : moved) position += way;
  if (grounds.size() > 1 || !grounds_under(model, body, moved).empty())
    return "move the body to where it is out of every ground, or the grounds further apart, or give the body a smaller scale";
  return fmt::format("move the body by [{:.6g}, {:.6g}, {:.6g}], which leaves {:.3g} m between them, or move the ground", way.x,
                     way.y, way.z, gap);
}

void expect_out_of_grounds(const Model& model, std::span<const glm::dvec3> positions, const CollisionDescription& collision,
                           const std::string& place) {
  for (const ModelBody& body : model.bodies) {
    const std::vector<const Ground*> grounds = grounds_under(model, body, positions);
    if (grounds.empty()) continue;
    const Origin& where = grounds.front()->where;
    throw Error(where.place.empty() ? Origin{Origin::From::file, place} : where, described(grounds, body, positions),
                way_out_of(grounds, model, body, positions, collision));
  }
}

void expect_out_of_themselves(const Model& model, std::span<const glm::dvec3> positions, int precision, Nearness allowed,
                              const std::string& place) {
  for (const ModelBody& body : model.bodies) {
    if (!body.self_contact) continue;
    const OwnContacts own = own_contacts(model, body, positions, precision);
    const std::uint64_t pairs = own.touching > 0 ? own.touching : own.too_near;
    const std::string counted = fmt::format("in {} pair{} of triangles", pairs, pairs == 1 ? "" : "s");
    if (own.touching > 0)
      throw Error(ErrorKind::input, place,
                  fmt::format("body \"{}\" intersects itself {}, so self-contact can't keep it apart", body.name, counted),
                  "mend its mesh, such as by weld, or its stretch, or remove self_contact");
    if (own.too_near > 0 && allowed == Nearness::provable)
      throw Error(
          ErrorKind::input, place,
          fmt::format("body \"{}\" is too near itself to prove in fp{} that it stays apart, {}", body.name, precision, counted),
          precision == 32 ? "take --precision 64, or remove self_contact" : "remove self_contact");
  }
}

std::string described(const Model& model, const Overlap& overlap, int precision) {
  const std::string names =
      fmt::format("bodies \"{}\" and \"{}\"", model.bodies[overlap.first].name, model.bodies[overlap.second].name);
  if (overlap.distance > 0)
    return fmt::format("{} begin {:.3g} m apart, which is too near to prove in fp{} that they stay apart", names,
                       overlap.distance, precision);
  return overlap.depth > 0 ? fmt::format("{} intersect, at least {:.3g} m deep", names, overlap.depth)
                           : fmt::format("{} intersect, with no vertex of one inside the other", names);
}

std::string way_apart(const Model& model, const Overlap& overlap, int precision) {
  if (overlap.distance > 0)  // how far proofs need them apart is not known
    return precision == 32 ? "move them further apart, or take --precision 64" : "move them further apart";
  const bool in_rows = model.bodies[overlap.first].name_of_rows() == model.bodies[overlap.second].name_of_rows();
  const bool moves_first = model.bodies[overlap.second].is_rigid();
  const ModelBody& body = model.bodies[moves_first ? overlap.first : overlap.second];
  const glm::dvec3 way = without_signs_of_zeros((moves_first ? -1.0 : 1.0) * overlap.way_out);
  const bool may_reflect = model.grounds.empty() && std::ranges::none_of(model.bodies, &ModelBody::is_rigid);
  const char* other_way = may_reflect ? "write response = \"reflect\" in [collision], which lets bodies begin tangled"
                                      : "give one of them a smaller scale";
  return fmt::format("{}move them apart, such as \"{}\" by [{:.4g}, {:.4g}, {:.4g}], or {}",
                     in_rows ? "give their rows a larger spacing, " : "", body.name, way.x, way.y, way.z, other_way);
}

void expect_no_nearer(Nearness allowed, Simulation& simulation, const Model& model, const CollisionDescription& collision,
                      const std::string& place) {
  if (!simulation.collider().response_row().keeps_apart) return;
  const std::vector<glm::dvec3> positions = simulation.state().world_positions(model);
  const int precision = simulation.precision();
  expect_out_of_grounds(model, positions, collision, place);
  expect_out_of_themselves(model, positions, precision, allowed, place);
  const std::optional<Overlap> overlap = find_overlap(model, positions, collision, precision);
  if (overlap && (overlap->distance == 0 || allowed == Nearness::provable))
    throw Error(ErrorKind::input, place, described(model, *overlap, precision), way_apart(model, *overlap, precision));
}

double longest_edge(const Model& model, const ModelBody& body) {
  double longest = 0;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, glm::length(model.rest_position(model.triangles[t][k]) -
                                              model.rest_position(model.triangles[t][(k + 1) % 3])));
  return longest;
}

// The largest sum of a vertex's coordinates, without signs [m].
double distance_from_origin(const ModelBody& body, std::span<const glm::dvec3> positions) {
  double farthest = 0;
  for (const glm::dvec3& p : positions.subspan(body.first_vertex, body.vertex_count))
    farthest = std::max(farthest, physics::sum_of_sizes(p));
  return farthest;
}

// What decides how well contacts of a body are resolved.
struct Measures {
  physics::Surface surface;
  double longest_edge = 0, far = 0;  // `far` is its distance from the origin [m]
};

// What rounding takes of a contact of a body with one whose edges and radius are these, in numbers of this epsilon [m].
double rounding_of(const Measures& body, double radius, double other_edge, double other_radius, double epsilon) {
  const double size = std::sqrt(3.0) * (body.longest_edge + other_edge);
  return physics::margin_of_rounding(epsilon, size, physics::rounded_from(body.far, body.far, std::max(radius, other_radius)));
}

bool is_lost(double rounding, double gap) { return 4 * rounding > gap; }

// What is worst of all bodies. If even contacts with such a one are resolved, a body need not be compared with each.
struct Worst {
  double longest_edge = 0, radius = 0;                                                                   // [m]
  double gap = std::numeric_limits<double>::infinity(), edge = std::numeric_limits<double>::infinity();  // of surfaces

  Worst(const Model& model, const std::vector<Measures>& measures) {
    for (std::size_t b = 0; b < measures.size(); ++b) {
      if (model.bodies[b].triangle_count == 0) continue;
      longest_edge = std::max(longest_edge, measures[b].longest_edge);
      radius = std::max(radius, model.bodies[b].radius);
      gap = std::min(gap, measures[b].surface.gap);
      edge = std::min(edge, measures[b].surface.edge);
    }
  }
  double gap_to(const Measures& body) const {
    return physics::mean_of_pair(body.surface.gap, gap) * std::min(body.surface.edge, edge);
  }
};

std::vector<Measures> measures_of(const Model& model, const State& state, const CollisionDescription& collision) {
  const std::vector<glm::dvec3> positions = state.world_positions(model);
  std::vector<Measures> measures;
  for (const ModelBody& body : model.bodies)
    measures.push_back({.surface = surface_of(model, body, collision),
                        .longest_edge = longest_edge(model, body),
                        .far = distance_from_origin(body, positions)});
  return measures;
}

}  // namespace

std::vector<std::string> told_rounding(const Model& model, const State& state, const CollisionDescription& collision,
                                       int precision) {
  const std::vector<Measures> measures = measures_of(model, state, collision);
  const double epsilon = precision == 64 ? 0x1p-52 : 0x1p-23;
  const Worst worst(model, measures);
  std::vector<std::string> told;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const ModelBody& body = model.bodies[b];
    if (body.is_rigid() || body.triangle_count == 0) continue;
    if (!is_lost(rounding_of(measures[b], body.radius, worst.longest_edge, worst.radius, epsilon), worst.gap_to(measures[b])))
      continue;
    for (std::size_t k = 0; k < model.bodies.size(); ++k) {
      const ModelBody& other = model.bodies[k];
      if (k == b || other.triangle_count == 0) continue;
      const double margin = rounding_of(measures[b], body.radius, measures[k].longest_edge, other.radius, epsilon);
      const double gap = physics::gap_of_pair(measures[b].surface, measures[k].surface);
      if (!is_lost(margin, gap)) continue;
      told.push_back(fmt::format(
          "contacts of body \"{}\" with \"{}\" are lost in rounding: it takes {:.2g} m, and they keep a gap of {:.2g} m; {}",
          body.name, other.name, margin, gap,
          precision == 64 ? "move them nearer to the origin, or take longer edges" : "take --precision 64, or more equal edges"));
      break;
    }
  }
  return told;
}

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

void expect_apart(Simulation& simulation, const Model& model, const CollisionDescription& collision, const std::string& place) {
  expect_no_nearer(Nearness::provable, simulation, model, collision, place);
}

void expect_still_apart(Simulation& simulation, const Model& model, const CollisionDescription& collision,
                        const std::string& place) {
  expect_no_nearer(Nearness::any, simulation, model, collision, place);
}

void expect_provable(Simulation& simulation, const Model& model, const CollisionDescription& collision,
                     const std::string& place) {
  if (!simulation.collider().response_row().keeps_apart) return;
  const int precision = simulation.precision();
  const std::vector<glm::dvec3> positions = simulation.state().world_positions(model);
  expect_out_of_themselves(model, positions, precision, Nearness::provable, place);
  const std::optional<Overlap> overlap = find_overlap(model, positions, collision, precision);
  if (overlap)
    throw Error(
        ErrorKind::input, place,
        fmt::format("bodies \"{}\" and \"{}\" have come as near as {:.3g} m, which is too near to prove in fp{} that they "
                    "stay apart",
                    model.bodies[overlap->first].name, model.bodies[overlap->second].name, overlap->distance, precision),
        "go on with --precision 64");
}

}  // namespace pliant
