// Flights: what cuts leave alone of the motions of bodies near each other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "bench/contact/apart.hpp"
#include "support/device_bench.hpp"
#include "support/pocket.hpp"

namespace pliant {
namespace {

// Balls in a row, 0.2 m from one to the next, with numbers in no order, and one far away. So many that threads share all passes.
constexpr std::size_t in_row = 72, alone = in_row;
ModelAndState row_and_one() {
  std::vector<std::size_t> places(in_row);
  std::iota(places.begin(), places.end(), 0);
  std::ranges::shuffle(places, std::mt19937_64(20261125));
  places.push_back(2 * in_row);
  std::vector<BodySetup> setups;
  for (std::size_t k = 0; k < places.size(); ++k) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "ball"));
    setups.back().description.total_mass = 1 + static_cast<double>(k * k);
    setups.back().description.position = {2.2 * static_cast<double>(places[k]), 0, 0};
    setups.back().description.velocity = {0.01 * static_cast<double>(k), 0.2, 0.01 * static_cast<double>(places[k])};
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE(
    "an island is bodies whose boxes are within an edge, from one to the next, and flies as its bodies do by their masses") {
  const ModelAndState start = row_and_one();
  glm::dvec3 momentum(0.0);
  double mass = 0;
  const std::vector<glm::dvec3> velocities = start.state.world_velocities(start.model);
  for (std::size_t i = 0; i < start.model.bodies[alone].first_vertex; ++i) {
    momentum += start.model.body_of(i).vertex_mass * velocities[i];
    mass += start.model.body_of(i).vertex_mass;
  }
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
    CHECK(flights[alone].island == alone);
    CHECK(glm::length(velocity(0) - momentum / mass) < 1e-13);
    CHECK(glm::length(velocity(alone) - velocities.back()) < 1e-14);
  }
}

TEST_CASE(
    "an island has no flight if a triangle or a ground is near one of its bodies, and a static body's box alone does not "
    "matter") {
  struct Place {
    double x;
    bool has_ground, is_in_reach;
  };
  // The wall stands slanted, so that its box holds all balls.
  for (const Place& place : {Place{1.02, false, true}, Place{3, false, false}, Place{3, true, true}}) {
    CAPTURE(place.x, place.has_ground);
    std::vector<BodySetup> setups;
    for (const double along : {2.2, 4.4, 0.0}) {
      setups.push_back(soft(generate_mesh("icosphere:1"), "ball"));
      setups.back().description.position = {along, 0, along};
    }
    setups.push_back(soft({{{-50, -50, 50}, {50, -50, -50}, {0, 50, 0}}, {{0, 1, 2}}}, "wall"));  // in the plane x + z = 0
    setups.back().description.kind = BodyKind::immovable;
    setups.back().description.position = {-place.x / std::sqrt(2), 0, -place.x / std::sqrt(2)};
    GroundDescription ground;
    ground.point = {0, place.has_ground ? -1.02 : -20, 0};
    Bench cpu(make_cpu_device(1, 64), build_model(setups, glm::dvec3(0.0), {&ground, 1}), {"verlet", 0.004},
              {.response = {"impulse"}});
    cpu.begin();
    cpu.device->run(cpu.step(0));
    const auto flights = cpu.bodies.arrays.get<physics::Cluster>("cluster").download();
    for (std::size_t b = 0; b < 3; ++b) {
      const physics::Cluster& island = flights[flights[b].island];
      CHECK((island.cannot_fly == 0 && (island.is_beside_static == 1) == place.is_in_reach));
    }
    CHECK(flights[3].cannot_fly == 1);
  }
}

TEST_CASE("bodies that hook into each other give nothing to a static one whose box holds them") {
  std::vector<BodySetup> setups = pocket_setups({0, 20, 6});
  setups.push_back(soft(
      {{{-50, -50, -50}, {-50, -49, -50}, {-49, -50, -50}, {50, 50, 50}, {50, 49, 50}, {49, 50, 50}}, {{0, 1, 2}, {3, 4, 5}}},
      "corners"));
  setups.back().description.kind = BodyKind::immovable;
  setups[0].description.total_stiffness = 30;
  setups[1].description.total_stiffness = 60;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                        {.response = {"impulse"}, .gap = small_gap});
  const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 0.4);
  CHECK(seen.report.reverted_vertices > 0);
  CHECK(glm::length(seen.report.response.outside_impulse) < 1e-10);
  CHECK(glm::length(seen.momentum) < 1e-10);
}

// Relative to their flight, after so many steps [m].
std::vector<glm::dvec3> places_in_flight(const ModelAndState& start, const glm::dvec3& flight, std::uint64_t steps,
                                         std::uint64_t& cuts) {
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                        {.response = {"impulse"}, .gap = small_gap});
  simulation.advance(steps);
  cuts = simulation.report().reverted_vertices;
  std::vector<glm::dvec3> places = simulation.state().world_positions(start.model);
  for (glm::dvec3& place : places) place -= simulation.report().time * flight;
  return places;
}

// Of the first vertices, as many as are expected [m].
double largest_distance(const std::vector<glm::dvec3>& expected, const std::vector<glm::dvec3>& places) {
  double most = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) most = larger(most, glm::length(places[i] - expected[i]));
  return most;
}

TEST_CASE("cuts do not depend on how fast bodies fly along together") {
  std::uint64_t cuts = 0, cuts_in_flight = 0;
  const std::vector<glm::dvec3> expected = places_in_flight(ball_in_a_pocket(glm::dvec3(0.0)), glm::dvec3(0.0), 100, cuts);
  CHECK(cuts > 50);
  for (const glm::dvec3 flight : {glm::dvec3(0, 20, 6), glm::dvec3(400, -300, 100)}) {
    CAPTURE(flight.x);
    const std::vector<glm::dvec3> places = places_in_flight(ball_in_a_pocket(flight), flight, 100, cuts_in_flight);
    CHECK(cuts_in_flight == cuts);
    CHECK(largest_distance(expected, places) < 1e-6);
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
  CHECK(largest_distance(expected, places) < 1e-9);
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
                        {.response = {"impulse"}, .gap = small_gap});
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
                        {.response = {"impulse"}, .gap = small_gap});
  const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 0.5);
  CHECK(seen.report.reverted_vertices > 100);
  CHECK(seen.most - seen.first < 0.01);  // [J]
  CHECK(glm::length(seen.momentum) < 1e-2);
  CHECK(glm::length(seen.turning_change) < 5e-3);
}

// Lets the first body's cluster fly through all that is there. Returns whether there is one.
bool fly_far(DeviceArray<physics::Cluster>& cluster) {
  std::vector<physics::Cluster> clusters = cluster.download();
  clusters[0].motion.velocity[2] = 2e4;
  cluster.upload(clusters);
  return clusters.back().bodies > 0 && clusters[0].bodies > 0;
}

// The third body is in the way. It is no static one, because beside those there is no flight.
ModelAndState pocket_before_block(double distance) {
  std::vector<BodySetup> setups = pocket_setups(glm::dvec3(0.0));
  setups.push_back(soft(generate_mesh("cube:3"), "block"));
  setups[2].description.scale = 2;
  setups[2].description.total_mass = 100;
  setups[2].description.position = {0, 0, distance};
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE(
    "bodies that fly along together keep their places to the bit, and all turning, in a step in which they would meet "
    "something") {
  for (const double distance : {3.0, 4.0, 5.0, 6.0}) {
    CAPTURE(distance);
    const ModelAndState start = pocket_before_block(distance);
    Bench cpu(make_cpu_device(1, 64), start, {"verlet", 0.004}, {.response = {"impulse"}, .gap = small_gap});
    cpu.begin();
    const bench::ApartOracle oracle(start.model);
    const std::uint32_t of_both = start.model.bodies[2].first_vertex;
    std::vector<glm::vec4> before = cpu.bodies.world_positions.download(cpu.bodies.first_of_half(0), of_both);
    auto& cut = cpu.bodies.arrays.get<std::uint32_t>("cut");
    bool was_stopped = false;
    for (std::uint32_t step = 0; step < 250 && !was_stopped; ++step) {
      const std::uint32_t half = 1 - (step & 1);
      const bool flies = fly_far(cpu.bodies.arrays.get<physics::Cluster>("cluster"));
      const auto turning = [&] { return angular_momentum_about_centre(start.model, cpu.bodies.download(half)); };
      glm::dvec3 turning_before_cuts;
      for (const Pass& pass : cpu.step(step & 1)) {
        cpu.device->run({&pass, 1});
        // proofs cut the remaining vertices of the two at the block
        if (flies && pass.name == "expect_cuts") cut_by_hand(cut, of_both - start.model.bodies[1].vertex_count / 2);
        if (pass.name != "certify") continue;
        was_stopped = flies && cut.download()[physics::flight_stop_of(cpu.bodies.vertex_count, 0)] != physics::at_no_cut;
        turning_before_cuts = turning();
      }
      const std::vector<glm::vec4> after = cpu.bodies.world_positions.download(cpu.bodies.first_of_half(half), of_both);
      CHECK(oracle.pairs_not_apart(cpu.bodies.download(half).world_positions(start.model)) == 0);
      if (was_stopped) {
        CHECK(after == before);
        CHECK(glm::length(turning() - turning_before_cuts) < 1e-10);
      }
      before = after;
    }
    CHECK(was_stopped);
  }
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
