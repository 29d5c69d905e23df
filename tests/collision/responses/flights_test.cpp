// Flights: what cuts leave alone of the motions of bodies near each other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "bench/contact/apart.hpp"
#include "support/device_bench.hpp"
#include "support/pocket.hpp"

namespace pliant {
namespace {

// Seven balls in a row, 0.2 m from one to the next, with numbers in no order, and two far from them. One of those is beside a
// static body.
ModelAndState row_and_others() {
  const std::vector<double> places{2, 6, 0, 4, 5, 3, 1, 20, 30};
  std::vector<BodySetup> setups;
  for (std::size_t k = 0; k < places.size(); ++k) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "ball"));
    setups.back().description.total_mass = 1 + static_cast<double>(k * k);
    setups.back().description.position = {2.2 * places[k], 0, 0};
    setups.back().description.velocity = {0.1 * static_cast<double>(k), 0.2, 0.1 * places[k]};
  }
  setups.push_back(soft(generate_mesh("cube:2"), "wall"));
  setups.back().description.kind = BodyKind::immovable;
  setups.back().description.position = {2.2 * 30, 1.7, 0};
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("an island is bodies within an edge, from one to the next, and flies as all their mass does") {
  const ModelAndState start = row_and_others();
  const std::size_t in_row = 7, alone = 7, beside_wall = 8;
  glm::dvec3 momentum(0.0);
  double mass = 0;
  const std::vector<glm::dvec3> velocities = start.state.world_velocities(start.model);
  for (std::size_t i = 0; i < start.model.bodies[in_row].first_vertex; ++i) {
    momentum += start.model.body_of(i).vertex_mass * velocities[i];
    mass += start.model.body_of(i).vertex_mass;
  }
  const glm::dvec3 expected[2] = {momentum / mass, velocities[start.model.bodies[alone].first_vertex]};
  for (const unsigned threads : {1u, 4u}) {
    Bench cpu(make_cpu_device(threads, 64), start, {"verlet", 0.004}, {.response = {"impulse"}});
    cpu.begin();
    cpu.device->run(cpu.step(0));
    const auto flights = cpu.bodies.arrays.get<physics::Cluster>("cluster").download();
    const auto velocity = [&](std::size_t b) {
      const double* const v = flights[b].island_velocity;
      return glm::dvec3(v[0], v[1], v[2]);
    };
    for (std::size_t b = 0; b < in_row; ++b) CHECK(flights[b].island == 0);
    CHECK((flights[alone].island == alone && flights[beside_wall].island == beside_wall));
    CHECK(glm::length(velocity(0) - expected[0]) < 1e-14);
    CHECK(glm::length(velocity(alone) - expected[1]) < 1e-14);
    CHECK((flights[0].cannot_fly == 0 && flights[alone].cannot_fly == 0));
    CHECK((flights[beside_wall].cannot_fly == 1 && flights[beside_wall + 1].cannot_fly == 1));
  }
}

TEST_CASE("no body of an island flies if one of them is beside a static one") {
  std::vector<BodySetup> setups;
  for (const double place : {2.2, 4.4, 0.0}) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "ball"));
    setups.back().description.position = {place, 0, 0};
  }
  setups.push_back(soft(generate_mesh("cube:2"), "wall"));
  setups.back().description.kind = BodyKind::immovable;
  setups.back().description.position = {6, 0, 0};
  Bench cpu(make_cpu_device(1, 64), build_model(setups, glm::dvec3(0.0)), {"verlet", 0.004}, {.response = {"impulse"}});
  cpu.begin();
  cpu.device->run(cpu.step(0));
  const auto flights = cpu.bodies.arrays.get<physics::Cluster>("cluster").download();
  for (std::size_t b = 0; b < 3; ++b) CHECK((flights[b].island == 0 && flights[flights[b].island].cannot_fly == 1));
}

// Relative to their flight, after so many steps [m].
std::vector<glm::dvec3> places_in_flight(const ModelAndState& start, const glm::dvec3& flight, std::uint64_t steps,
                                         std::uint64_t& cuts) {
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                        {.response = {"impulse"}, .gap = 0.01});
  simulation.advance(steps);
  cuts = simulation.report().reverted_vertices;
  std::vector<glm::dvec3> places = simulation.state().world_positions(start.model);
  for (glm::dvec3& place : places) place -= simulation.report().time * flight;
  return places;
}

TEST_CASE("cuts do not depend on how fast bodies fly along together") {
  std::uint64_t cuts = 0, cuts_in_flight = 0;
  const std::vector<glm::dvec3> expected = places_in_flight(ball_in_a_pocket(glm::dvec3(0.0)), glm::dvec3(0.0), 100, cuts);
  CHECK(cuts > 50);
  for (const glm::dvec3 flight : {glm::dvec3(0, 20, 6), glm::dvec3(400, -300, 100)}) {
    CAPTURE(flight.x);
    const std::vector<glm::dvec3> places = places_in_flight(ball_in_a_pocket(flight), flight, 100, cuts_in_flight);
    CHECK(cuts_in_flight == cuts);
    double most = 0;
    for (std::size_t i = 0; i < places.size(); ++i) most = larger(most, glm::length(places[i] - expected[i]));
    CHECK(most < 1e-6);
  }
}

// Within a step it could go past the others, some 5 m away.
TEST_CASE("a light body that passes at a distance changes no cut") {
  std::vector<BodySetup> setups = pocket_setups(glm::dvec3(0.0));
  setups.push_back(soft(generate_mesh("icosphere:0"), "bullet"));
  setups[2].description.scale = 0.1;
  setups[2].description.total_mass = setups[2].description.total_stiffness = 1e-6;
  setups[2].description.position = {6, 0, -176};
  setups[2].description.velocity = {0, 0, 2000};
  std::uint64_t cuts = 0, cuts_beside = 0;
  const std::vector<glm::dvec3> expected = places_in_flight(ball_in_a_pocket(glm::dvec3(0.0)), glm::dvec3(0.0), 100, cuts);
  const std::vector<glm::dvec3> places =
      places_in_flight(build_model(setups, glm::dvec3(0.0)), glm::dvec3(0.0), 100, cuts_beside);
  CHECK(cuts > 50);
  CHECK(cuts_beside == cuts);
  double most = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) most = larger(most, glm::length(places[i] - expected[i]));
  CHECK(most < 1e-9);
}

// The boxes of the balls and of the heavy body overlap, but the bodies don't touch.
TEST_CASE("a heavy body that passes by turns none of those that hook into each other") {
  std::vector<BodySetup> setups = pocket_setups(glm::dvec3(0.0));
  setups.push_back(soft(generate_mesh("icosphere:1"), "heavy"));
  setups[2].description.scale = 3;
  setups[2].description.total_mass = 1e4;
  setups[2].description.position = {2.8, 2.8, 2.8};
  setups[2].description.velocity = {2, -2, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                        {.response = {"impulse"}, .gap = 0.01});
  const glm::dvec3 heavy_before = start.state.world_velocities(start.model).back();
  simulation.advance(120);
  CHECK(simulation.report().reverted_vertices > 1000);
  const glm::dvec3 change = angular_momentum_about_centre(start.model, simulation.state(), 2) -
                            angular_momentum_about_centre(start.model, start.state, 2);
  CHECK(glm::length(change) < 5e-3);
  CHECK(glm::length(simulation.state().world_velocities(start.model).back() - heavy_before) < 1e-6);
}

// The boxes of the large one and of the third overlap, but the bodies don't touch. If what is held stayed behind in the world
// because of that, the flight would stretch the bodies.
TEST_CASE("bodies that hook into each other gain no energy where another one flies beside them") {
  const glm::dvec3 flight(0, 20, 6);
  std::vector<BodySetup> setups = pocket_setups(flight);
  setups.push_back(soft(generate_mesh("icosphere:2"), "third"));
  setups[2].description.position = {-0.4, 1.6, 1.6};
  setups[2].description.velocity = flight;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                        {.response = {"impulse"}, .gap = 0.01});
  const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 0.5);
  CHECK(seen.report.reverted_vertices > 100);
  CHECK(seen.most - seen.first < 0.01);  // [J]
  CHECK(glm::length(seen.momentum) < 1e-2);
  CHECK(glm::length(seen.turning_change) < 5e-3);
}

// Lets the first body's cluster fly through the wall. Returns whether there is one.
bool fly_into_wall(DeviceArray<physics::Cluster>& cluster) {
  std::vector<physics::Cluster> clusters = cluster.download();
  clusters[0].motion.velocity[2] = 2e4;
  cluster.upload(clusters);
  return clusters.back().bodies > 0 && clusters[0].bodies > 0;
}

TEST_CASE(
    "bodies that fly along together keep their places to the bit, and their turning, in a step in which they would meet "
    "something") {
  const ModelAndState start = pocket_before_wall(0, 4);
  Bench cpu(make_cpu_device(1, 64), start, {"verlet", 0.004}, {.response = {"impulse"}, .gap = 0.01});
  cpu.begin();
  const bench::ApartOracle oracle(start.model);
  std::vector<glm::vec4> before = cpu.bodies.world_positions.download(cpu.bodies.first_of_half(0), cpu.bodies.vertex_count);
  auto& cut = cpu.bodies.arrays.get<std::uint32_t>("cut");
  const auto is_stopped = [&] {
    return cut.download()[physics::flight_stop_of(cpu.bodies.vertex_count, 0)] != physics::at_no_cut;
  };
  int stops = 0;
  for (std::uint32_t step = 0; step < 250; ++step) {
    const std::uint32_t half = 1 - (step & 1);
    const bool flies = fly_into_wall(cpu.bodies.arrays.get<physics::Cluster>("cluster"));
    bool was_stopped = false;
    const auto turning = [&] { return angular_momentum_about_centre(start.model, cpu.bodies.download(half), 2); };
    glm::dvec3 turning_before_cuts;
    for (const Pass& pass : cpu.step(step & 1)) {
      cpu.device->run({&pass, 1});
      if (flies && pass.name == "expect_cuts") cut_by_hand(cut, start.model.bodies[2].first_vertex);
      if (pass.name != "certify") continue;
      was_stopped = flies && is_stopped();
      turning_before_cuts = turning();
    }
    if (was_stopped) CHECK(glm::length(turning() - turning_before_cuts) < 1e-12);
    const std::vector<glm::vec4> after =
        cpu.bodies.world_positions.download(cpu.bodies.first_of_half(half), cpu.bodies.vertex_count);
    CHECK(oracle.pairs_not_apart(cpu.bodies.download(half).world_positions(start.model)) == 0);
    if (was_stopped) CHECK(after == before);
    if (was_stopped) ++stops;
    before = after;
  }
  CHECK(stops > 3);
}

// A small triangle and a long one, on either side of a plane. They are some 0.1 mm apart.
ModelAndState triangles_beside_a_plane(std::mt19937_64& engine, const glm::dvec3& velocity) {
  const auto random = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); };
  const glm::dvec3 normal = glm::normalize(glm::dvec3(random(-1, 1), random(-1, 1), random(-1, 1)) + glm::dvec3(1e-3));
  std::vector<BodySetup> setups;
  for (const double side : {1.0, -1.0}) {
    TriangleMesh mesh{{}, {{0, 1, 2}}};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 place = (side > 0 ? 2.0 : 30.0) * glm::dvec3(random(-1, 1), random(-1, 1), random(-1, 1));
      mesh.positions.push_back(place + (side * (5e-5 + std::pow(10, random(-6, -1))) - glm::dot(place, normal)) * normal);
    }
    setups.push_back(soft(std::move(mesh), side > 0 ? "small" : "long"));
    setups.back().description.velocity = velocity;
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("bodies that fly along together are not stopped where fp32 can't tell that they are apart") {
  std::mt19937_64 engine(20261125);
  const glm::dvec3 velocity(0.3, -0.2, 0.1);
  const double time_step = 1e-3;
  int not_proven = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const ModelAndState start = triangles_beside_a_plane(engine, velocity);
    Bench cpu(make_cpu_device(1, 32), start, {"verlet", time_step}, {.response = {"impulse"}, .gap = 1e-6});
    cpu.begin();
    auto& clusters = cpu.bodies.arrays.get<physics::Cluster>("cluster");
    std::vector<physics::Cluster> both = clusters.download();
    both[0].bodies = both.back().bodies = 2;
    both[0].first = both[1].first = 0;
    for (std::uint32_t k = 0; k < 3; ++k) both[0].motion.velocity[k] = velocity[static_cast<int>(k)];
    clusters.upload(both);
    for (const Pass& pass : cpu.step(0)) {
      cpu.device->run({&pass, 1});
      if (pass.name == "certify" &&
          cpu.bodies.arrays.get<physics::ContactList>("contact_list").download().front().rounds_that_cut > 0)
        ++not_proven;
    }
    const auto before = start.state.world_positions(start.model), after = cpu.bodies.download(1).world_positions(start.model);
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(glm::length(after[i] - before[i] - time_step * velocity) < 1e-9);
  }
  CHECK(not_proven > 0);
}

}  // namespace
}  // namespace pliant
