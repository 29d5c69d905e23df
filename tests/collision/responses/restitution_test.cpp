// What bodies keep of their approach where a scene asks for restitution.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "physics/contact/impact.glsl"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

// What is left of the approach after spheres of 1 kg met at 2 m/s, by the centres of mass.
struct Parting {
  double kept = 0;             // of the speed of the first sphere
  double momentum_change = 0;  // [Ns]
  double turning_change = 0, most_energy = 0;
  StepReport report;
};

glm::dvec3 mean_velocity(const Model& model, const State& state, const ModelBody& body) {
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) sum += velocities[i];
  return sum / static_cast<double>(body.vertex_count);
}

ModelAndState spheres_in_flight(double off_centre, double stiffness, std::optional<double> first, std::optional<double> second) {
  std::vector<BodySetup> setups;
  for (const double side : {-1.0, 1.0}) {
    BodySetup& setup = setups.emplace_back(soft(generate_mesh("icosphere:2"), side < 0 ? "left" : "right"));
    setup.description.position = {1.05 * side, off_centre * side, 0};
    setup.description.rotation = {10 * side, 20, 0};
    setup.description.velocity = {-side, 0, 0};
    setup.description.total_stiffness = stiffness;
    setup.description.restitution = side < 0 ? first : second;
  }
  return build_model(setups, glm::dvec3(0.0));
}

Parting part_after_impact(const ModelAndState& start, double stiffness, const glm::dvec3& gravity = glm::dvec3(0.0),
                          std::optional<double> of_scene = {}) {
  const double time_step = 0.3 / std::sqrt(stiffness);
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", time_step}),
                        {.response = {"impulse"}, .elasticity = 0, .friction = 0, .restitution = of_scene});
  const ModelBody& body = start.model.bodies[0];
  const double before = glm::length(mean_velocity(start.model, start.state, body));
  const Energies seen = energies_of(simulation, start, gravity, 80 / std::sqrt(stiffness));
  return {.kept = glm::length(mean_velocity(start.model, simulation.state(), body)) / before,
          .momentum_change = glm::length(seen.momentum),
          .turning_change = glm::length(seen.turning_change),
          .most_energy = seen.most / seen.first,
          .report = seen.report};
}

// It would be pressed together, and contacts would give it energy for ever.
TEST_CASE("a stack with a restitution of 0 rests as one does that has no such key") {
  std::vector<BodySetup> setups;
  for (int i = 0; i < 3; ++i) {
    BodySetup& setup = setups.emplace_back(soft(generate_mesh("cube:3"), "cube"));
    setup.description.position = {0.001 * i, 0.53 + 1.05 * i, 0};
    setup.description.total_stiffness = 1e4;
    setup.description.damping = 0.1;
  }
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, gravity, {&ground, 1});
  const auto device = make_cpu_device(1, 64);
  struct AtRest {
    Measurement measured;
    double given;  // by contacts in the last thousand steps [J]
  };
  const auto rest_with = [&](std::optional<double> restitution) {
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.003, DampingLaw::internal}),
                          {.response = {"impulse"}, .elasticity = 0, .restitution = restitution});
    simulation.advance(3000);
    const double before = simulation.report().response.energy_given;
    simulation.advance(1000);
    ThreadPool pool(1);
    return AtRest{measure(start.model, simulation.state(), gravity, pool), simulation.report().response.energy_given - before};
  };
  const AtRest without = rest_with({}), with = rest_with(0);
  CHECK(with.given < 2 * without.given);
  CHECK(with.measured.elastic == Approx(without.measured.elastic).epsilon(0.1));
  CHECK(with.measured.energy() == Approx(without.measured.energy()).epsilon(0.002));
}

TEST_CASE("spheres keep the part of their approach that restitution asks for") {
  for (const double restitution : {0.9, 0.7, 0.5}) {
    CAPTURE(restitution);
    const Parting parting = part_after_impact(spheres_in_flight(0, total_stiffness, restitution, restitution), total_stiffness);
    CHECK(parting.kept == Approx(restitution).margin(0.1));
    CHECK(parting.momentum_change < 1e-14);
    CHECK(parting.most_energy < 1.001);
  }
  CHECK(part_after_impact(spheres_in_flight(0, total_stiffness, 0, 0), total_stiffness).kept < 0.4);
}

TEST_CASE("restitution keeps the angular momentum of spheres that meet off their centres as well as other contact does") {
  const Parting with = part_after_impact(spheres_in_flight(0.5, total_stiffness, 0.3, 0.3), total_stiffness);
  const Parting without = part_after_impact(spheres_in_flight(0.5, total_stiffness, {}, {}), total_stiffness);
  CHECK(with.report.contact_steps > 5);
  CHECK(with.momentum_change < 1e-14);
  CHECK(with.turning_change < 2 * without.turning_change + 1e-13);
  CHECK(with.most_energy < 1.001);
}

TEST_CASE("the restitution of two bodies is the geometric mean, or that of the only one that has any") {
  const auto kept = [](std::optional<double> first, std::optional<double> second, std::optional<double> of_scene = {}) {
    return part_after_impact(spheres_in_flight(0, total_stiffness, first, second), total_stiffness, glm::dvec3(0.0), of_scene)
        .kept;
  };
  const double half = kept(0.5, 0.5);
  CHECK(kept(0.25, 1) == half);
  CHECK(kept(0.5, {}) == half);
  CHECK(kept({}, {}, 0.5) == half);
  CHECK(kept({}, {}) > half + 0.2);
}

TEST_CASE("a ball leaves a ground, and a static body, with what its restitution asks for") {
  BodySetup ball = soft(generate_mesh("icosphere:2"), "ball");
  ball.description.position = {0, 1.05, 0};
  ball.description.velocity = {0, -1, 0};
  ball.description.rotation = {10, 20, 0};
  ball.description.restitution = 0.5;
  const GroundDescription ground;
  const ModelAndState on_plane = build_model({&ball, 1}, glm::dvec3(0.0), {&ground, 1});
  CHECK(part_after_impact(on_plane, total_stiffness).kept == Approx(0.5).margin(0.1));
  BodySetup slab = soft(generate_mesh("cube:3"), "slab");
  slab.description.kind = BodyKind::immovable;
  slab.description.scale = 4;
  slab.description.position = {0, -2, 0};
  const std::vector<BodySetup> both = {ball, slab};
  CHECK(part_after_impact(build_model(both, glm::dvec3(0.0)), total_stiffness).kept == Approx(0.5).margin(0.1));
}

TEST_CASE("impacts with restitution give the same bits on any number of threads, and after saving amid one") {
  const ModelAndState start = spheres_in_flight(0.2, total_stiffness, 0.5, 0.3);
  const SavedRun run = check_same_bits(start, {"verlet", 0.3 / omega}, by_impulses, 20, 60);
  CHECK(run.saved.contact_steps > 5);
}

// Directions that are spread evenly.
std::vector<glm::dvec3> directions(std::size_t count) {
  std::vector<glm::dvec3> all;
  for (std::size_t k = 0; k < count; ++k) {
    const double y = 1 - 2 * (static_cast<double>(k) + 0.5) / static_cast<double>(count),
                 angle = 2.39996323 * static_cast<double>(k);
    all.emplace_back(std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle));
  }
  return all;
}

// Bodies of one mesh that come from all sides to the middle, with their origins in this distance.
void add_comers(std::vector<BodySetup>& setups, const TriangleMesh& mesh, std::size_t count, double distance, double mass,
                std::optional<double> restitution = 0.5) {
  for (const glm::dvec3& direction : directions(count)) {
    BodySetup& setup = setups.emplace_back(soft(mesh, ""));
    setup.description.name = "comer " + std::to_string(setups.size());
    setup.description.position = distance * direction;
    setup.description.velocity = -direction;
    const double turned = std::acos(direction.y) * 180 / M_PI, heading = std::atan2(direction.x, direction.z) * 180 / M_PI;
    setup.description.rotation = {turned, heading, 0};  // its y axis points outward
    setup.description.total_mass = mass;
    setup.description.total_stiffness = mass * total_stiffness;
    setup.description.restitution = restitution;
  }
}

// The number of bodies that the first one touches.
std::size_t partners_of_first(Simulation& simulation, const Model& model) {
  std::set<std::uint32_t> partners;
  for (const ContactImpulse& contact : simulation.contact_impulses())
    for (int k = 0; k < 4; ++k)
      if (contact.vertex[k] != physics::no_vertex) partners.insert(model.body_index(contact.vertex[k]));
  partners.erase(0);
  return partners.size();
}

struct Leaving {
  std::vector<double> speeds;  // of small balls, away from the large one
  std::size_t most_partners = 0;
};

Leaving leave_large_ball(std::size_t count, std::optional<double> restitution) {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:3"), "large")};
  setups[0].description.total_mass = 1000;
  setups[0].description.total_stiffness = 1e6;
  TriangleMesh small = generate_mesh("icosphere:1");
  for (glm::dvec3& place : small.positions) place *= 0.08;
  add_comers(setups, small, count, 1.12, 0.001, restitution);
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.1 / omega}),
                        {.response = {"impulse"}, .elasticity = 1});
  Leaving leaving;
  for (int k = 0; k < 100; ++k) {
    simulation.advance(3);
    leaving.most_partners = std::max(leaving.most_partners, partners_of_first(simulation, start.model));
  }
  const State state = simulation.state();
  for (std::size_t b = 1; b < setups.size(); ++b)
    leaving.speeds.push_back(
        glm::dot(mean_velocity(start.model, state, start.model.bodies[b]), glm::normalize(setups[b].description.position)));
  return leaving;
}

TEST_CASE("a hundred small balls leave a large one, each with what its restitution asks for") {
  const Leaving leaving = leave_large_ball(100, 0.5), without = leave_large_ball(100, {});
  CHECK(leaving.most_partners > physics::impact_places);
  for (const double speed : leaving.speeds) CHECK(speed == Approx(0.5).margin(0.1));
  CHECK(std::accumulate(without.speeds.begin(), without.speeds.end(), 0.0) / 100 > 0.65);
}

TEST_CASE("a body that touches more large ones than it has places for gives the same bits on any number of threads") {
  const std::vector<glm::dvec3> corners = {{0, 0, 0}, {0.06, 3, 0}, {-0.03, 3, 0.05}, {-0.03, 3, -0.05}};
  const TriangleMesh spike{corners, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:2"), "ball")};
  add_comers(setups, spike, 90, 1.04, 0.1);
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const Method method{"verlet", 0.1 / omega};
  check_same_bits(start, method, by_impulses, 20, 60);
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(method), by_impulses);
  std::size_t most = 0;
  for (int k = 0; k < 60; ++k) {
    simulation.advance(1);
    most = std::max(most, partners_of_first(simulation, start.model));
  }
  CHECK(most > physics::impact_places);
}

}  // namespace
}  // namespace pliant
