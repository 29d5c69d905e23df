#include "bench/contact/rest.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "bench/contact/apart.hpp"
#include "core/larger.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "model/mean_edge.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr glm::dvec3 gravity(0, -9.81, 0);
constexpr double damping_rate = 0.1;  // over the stiffest frequency

BodySetup moving(const char* mesh, const glm::dvec3& position, double radius = 1, double mass = 1, double stiffness = 1000) {
  BodySetup setup;
  setup.mesh = generate_mesh(mesh);
  BodyDescription& body = setup.description;
  body.name = "body";
  body.scale = radius;
  body.position = position;
  body.total_mass = mass;
  body.total_stiffness = stiffness;
  const ModelBody built = build_model({&setup, 1}, gravity).model.bodies.front();
  body.damping = damping_rate * stiffest_frequency(built) * built.vertex_mass;
  return setup;
}

BodySetup standing(const char* mesh, double scale, const glm::dvec3& position = glm::dvec3(0.0)) {
  BodySetup setup;
  setup.mesh = generate_mesh(mesh);
  setup.description.name = "support";
  setup.description.kind = BodyKind::immovable;
  setup.description.scale = scale;
  setup.description.position = position;
  return setup;
}

std::vector<BodySetup> turned(std::vector<BodySetup> setups) {
  setups.back().description.rotation = {10, 20, 0};  // a symmetric body would be decided by rounding
  return setups;
}

std::vector<BodySetup> ball_between_posts() {
  std::vector<BodySetup> setups;
  for (int k = 0; k < 4; ++k) {
    const double angle = 0.5 * std::numbers::pi * k;
    setups.push_back(standing("icosphere:2", 1, {1.6 * std::cos(angle), 0, 1.6 * std::sin(angle)}));
    setups.back().description.rotation = {13.0 * k, 7.0 * k, 3};
  }
  setups.push_back(moving("icosphere:2", {0, 1.4, 0}));
  return turned(std::move(setups));
}

// With a third of this stiffness the stack leans over slowly, because its own weight makes the soft column buckle.
std::vector<BodySetup> stack_of_cubes() {
  std::vector<BodySetup> setups = {standing("cube:8", 4, {0, -2, 0})};
  for (int k = 0; k < 3; ++k) {
    setups.push_back(moving("cube:4", {0, 0.52 + 1.04 * k, 0}, 1, 1, 1.5e4));
    setups.back().description.rotation = {0, 20.0 + 25 * k, 0};
  }
  return setups;
}

RestingPlace place_of(const char* name, std::vector<BodySetup> setups, std::span<const GroundDescription> grounds = {}) {
  return {.name = name, .start = build_model(setups, gravity, grounds)};
}

}  // namespace

std::vector<RestingPlace> resting_places() {
  const GroundDescription ground;
  std::vector<RestingPlace> places;
  places.push_back(place_of("ball on a ground", turned({moving("icosphere:2", {0, 1.03, 0})}), {&ground, 1}));
  places.push_back(
      place_of("ball on a slab", turned({standing("cube:8", 4, {0, -2, 0}), moving("icosphere:2", {0.07, 1.03, 0.03})})));
  places.push_back(
      place_of("ball in a bowl", turned({standing("icosphere:3", 3, {0, 3, 0}), moving("icosphere:2", {0, 1.1, 0})})));
  places.push_back(place_of("ball between posts", ball_between_posts()));
  places.push_back(place_of("5 cm on 10 m edges", turned({standing("cube:1", 10, {0, -5, 0}),
                                                          moving("icosphere:2", {0.1, 0.052, 0.2}, 0.05, 0.01, 100)})));
  places.push_back(place_of("stack of three cubes", stack_of_cubes()));
  return places;
}

RestSeen watch_rest(Device& device, const RestingPlace& place, const RestWatch& how) {
  const Model& model = place.start.model;
  const ModelBody& body = model.bodies.back();
  const TimePlan plan{
      .integrator = &find_integrator("verlet"), .time_step = 0.3 / stiffest_frequency(body), .damping_law = DampingLaw::constant};
  Simulation simulation(device, model, place.start.state, plan, {.response = {"impulse"}, .elasticity = 0});
  for (std::uint64_t step = 0; step < how.settling && !how.stop.stop_requested(); step += 100)
    simulation.advance(std::min<std::uint64_t>(100, how.settling - step));
  RestSeen seen{.edge = mean_edge(model, body)};
  const std::uint64_t cut = simulation.report().reverted_vertices;
  const std::vector<glm::dvec3> first = simulation.state().world_positions(model);
  std::vector<glm::dvec3> before = first;
  for (std::uint64_t step = 0; step < how.watched && !how.stop.stop_requested(); ++step) {
    simulation.advance(1);
    std::vector<glm::dvec3> now = simulation.state().world_positions(model);
    for (std::size_t i = 0; i < now.size(); ++i) {
      seen.most_a_step = larger(seen.most_a_step, glm::length(now[i] - before[i]) / seen.edge);
      seen.drift = larger(seen.drift, glm::length(now[i] - first[i]) / seen.edge);
    }
    before = std::move(now);
  }
  seen.cut_vertices = simulation.report().reverted_vertices - cut;
  seen.contacts = simulation.contact_impulses().size();
  seen.inside = ApartOracle(model).vertices_inside_others(before);
  return seen;
}

}  // namespace pliant::bench
