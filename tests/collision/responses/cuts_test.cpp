// Motions that are cut short: bodies pay for the energy, and momentum stays.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/contact/apart.hpp"
#include "bench/contact/meeting.hpp"
#include "support/device_bench.hpp"
#include "support/pocket.hpp"

namespace pliant {
namespace {

// A ball that falls on a small static one.
ModelAndState ball_over_knob(double stiffness, double knob_radius) {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "knob"), soft(generate_mesh("icosphere:2"), "ball")};
  setups[0].description.kind = BodyKind::immovable;
  setups[0].description.scale = knob_radius;
  setups[1].description.position = {0.03, 1.3, 0.02};
  setups[1].description.rotation = {10, 20, 30};
  setups[1].description.total_stiffness = stiffness;
  GroundDescription ground;
  ground.point = {0, -1.03, 0};
  return build_model(setups, {0, -9.81, 0}, {&ground, 1});
}

TEST_CASE("motions that are cut short add no energy, and what does not move tells what it gave") {
  struct Fall {
    double stiffness, knob_radius, time_step;
  };
  // With a small gap, because with the usual one nothing is cut.
  for (const Fall& fall : {Fall{100, 0.12, 0.01}, Fall{300, 0.2, 0.01}, Fall{1000, 0.2, 0.02}}) {
    for (const int precision : {64, 32}) {
      CAPTURE(fall.stiffness, precision);
      const ModelAndState start = ball_over_knob(fall.stiffness, fall.knob_radius);
      const auto device = make_cpu_device(1, precision);
      Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", fall.time_step}),
                            {.response = {"impulse"}, .elasticity = 0, .friction = 0, .gap = small_gap});
      const Energies seen = energies_of(simulation, start, {0, -9.81, 0}, 2);
      CHECK(seen.report.reverted_vertices > 20);
      CHECK(seen.most < 1.001 * seen.first);
      CHECK(glm::length(seen.momentum) < (precision == 64 ? 1e-11 : 1e-4));
    }
  }
}

// Two balls that meet where they have many triangles, so that proofs of pairs wait for each other in several turns of a work
// group.
ModelAndState balls_that_meet() {
  std::vector<BodySetup> setups;
  for (const double side : {-1.0, 1.0}) {
    setups.push_back(soft(generate_mesh("icosphere:3"), side < 0 ? "left" : "right"));
    setups.back().description.position = {1.01 * side, 0, 0};
    setups.back().description.velocity = {-2 * side, 0, 0};
    setups.back().description.stretch = {1, 1.1, 1.1};
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("proofs cut motions short that contacts do not answer, on every device", "[gl]") {
  const ModelAndState start = balls_that_meet();
  const bench::ApartOracle oracle(start.model);
  for (TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Bench run(std::move(test.device), start, {"verlet", 0.01}, {.response = {"impulse"}});
    run.begin();
    std::uint32_t most_pairs = 0;
    for (std::uint32_t step = 0; step < 12; ++step) {
      for (const Pass& pass : run.step(step & 1)) {
        if (pass.name != "find_contacts") run.device->run({&pass, 1});
        if (pass.name == "certify")
          most_pairs = std::max(
              most_pairs, run.bodies.arrays.get<physics::ContactList>("contact_list").download().front().triangle_pair_count);
      }
      CHECK(oracle.pairs_not_apart(run.bodies.download(1 - (step & 1)).world_positions(start.model)) == 0);
    }
    CHECK(most_pairs > 1000);
    CHECK(run.bodies.control.download().front().total_low[physics::reverted_vertices] > 20);
  }
}

// A heavy cube falls on a light soft one that lies on a static one.
ModelAndState light_under_heavy() {
  std::vector<BodySetup> setups = {soft(generate_mesh("cube:3"), "static"), soft(generate_mesh("cube:3"), "light"),
                                   soft(generate_mesh("cube:1"), "heavy")};
  setups[0].description.kind = BodyKind::immovable;
  setups[0].description.position = {0.1, 1.1, -0.1};
  setups[0].description.rotation = {20, 30, 50};
  setups[1].description.position = {0, 3.2, 0};
  setups[1].description.rotation = {40, 70, 10};
  setups[1].description.total_mass = 10;
  setups[1].description.total_stiffness = 1000;
  setups[2].description.scale = 1.5;
  setups[2].description.position = {0, 5.5, 0};
  setups[2].description.rotation = {10, 20, 50};
  setups[2].description.velocity = {0, -5, 0};
  setups[2].description.total_mass = 1000;
  setups[2].description.total_stiffness = 2e5;
  return build_model(setups, {0, -9.81, 0});
}

glm::dvec3 mean_of(const Model& model, const std::vector<glm::dvec3>& of_vertices) {
  glm::dvec3 sum(0.0);
  double mass = 0;
  for (std::uint32_t i = 0; i < of_vertices.size(); ++i) {
    if (model.body_of(i).is_rigid()) continue;
    sum += model.body_of(i).vertex_mass * of_vertices[i];
    mass += model.body_of(i).vertex_mass;
  }
  return sum / mass;
}

// How much faster the centre of all masses falls on average than it gets down [m/s].
double mean_excess_speed(Simulation& simulation, const Model& model, double duration) {
  const double begin = simulation.report().time, height = mean_of(model, simulation.state().world_positions(model)).y;
  double last = begin, fallen = 0;
  while (last < begin + duration) {
    simulation.advance(1);
    const double now = simulation.report().time;
    fallen -= (now - last) * mean_of(model, simulation.state().world_velocities(model)).y;
    last = now;
  }
  return (fallen - (height - mean_of(model, simulation.state().world_positions(model)).y)) / duration;
}

// If nothing paid with its rigid motion, both would stand still for good while gravity goes on adding to their velocities.
TEST_CASE("bodies that jam on a static one give it their momentum") {
  for (const int precision : {64, 32}) {
    CAPTURE(precision);
    const ModelAndState start = light_under_heavy();
    const auto device = make_cpu_device(1, precision);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.002}),
                          {.response = {"impulse"}, .gap = small_gap});
    const Energies seen = energies_of(simulation, start, {0, -9.81, 0}, 1.2);
    CHECK(seen.report.reverted_vertices > 20);
    CHECK(seen.most < 1.001 * seen.first);
    CHECK(glm::length(seen.momentum) < (precision == 64 ? 1e-8 : 1e-2));
    CHECK(mean_excess_speed(simulation, start.model, 0.5) < 0.1);
  }
}

// A body that oscillates wildly beside another one.
ModelAndState wild_beside_still() {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "wild"), soft(generate_mesh("icosphere:1"), "still")};
  setups[0].description.stretch = {0.3, 1, 1};
  setups[0].description.velocity = {1, 0.3, 0};
  setups[1].description.position = {1.45, 0, 0};
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("motions that a kick could not foresee are cut short, which keeps bodies apart and momentum, and pays for the energy") {
  const ModelAndState start = wild_beside_still();
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 1.0 / omega}), by_impulses);
  const bench::Seen seen = bench::watch(simulation, start, {.steps = 60});
  CHECK(seen.touching == 0);
  CHECK(seen.inside == 0);
  CHECK(seen.report.reverted_vertices > 0);
  CHECK(seen.momentum_change < 1e-14);
  CHECK(seen.most_energy < 1e-3);
}

// The wild one, with others around it. All fly along, so fast that rounding shows.
ModelAndState wild_among_others() {
  const glm::dvec3 flight(7000, 3000, 1000);  // [m/s]
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "wild")};
  setups[0].description.stretch = {0.3, 1, 1};
  setups[0].description.velocity = flight + glm::dvec3(1, 0.3, 0);
  for (const glm::dvec3 place : {glm::dvec3(1.45, 0, 0), {-1.47, 0, 0}, {0.05, 2.02, 0.1}, {0, 0.1, 2.03}, {-0.1, 0, -2.01}}) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "still"));
    setups.back().description.name = fmt::format("still {}", setups.size());
    setups.back().description.position = place;
    setups.back().description.velocity = flight - place;
  }
  return build_model(setups, glm::dvec3(0.0));
}

// Turns the list of near pairs round, with the numbers by which bodies and pairs name pairs.
void turn_round_pairs(DeviceBodies& bodies) {
  const std::uint32_t count = bodies.control.download().front().near_pair_count;
  const auto turn_number = [&](std::uint32_t& number) { number = number == 0 ? 0 : count + 1 - number; };
  auto& pairs = bodies.arrays.get<glm::uvec4>("near_pair");
  std::vector<glm::uvec4> listed = pairs.download(0, count);
  std::ranges::reverse(listed);
  for (glm::uvec4& pair : listed) {
    turn_number(pair.z);
    turn_number(pair.w);
  }
  pairs.upload(listed);
  std::vector<physics::Status> statuses = bodies.statuses.download();
  for (physics::Status& status : statuses) turn_number(status.first_pair);
  bodies.statuses.upload(statuses);
}

TEST_CASE("the order of pairs of bodies does not matter where motions are cut short") {
  std::vector<std::vector<double>> motions;
  std::uint64_t cuts = 0;
  for (const bool turns_round : {false, true}) {
    Bench cpu(make_cpu_device(1, 64), wild_among_others(), {"cv8", 1 / omega}, {.response = {"impulse"}, .gap = small_gap});
    cpu.begin();
    for (std::uint32_t step = 0; step < 150; ++step)
      for (const Pass& pass : cpu.step(step & 1)) {
        if (pass.name == "pay_dues" && turns_round) turn_round_pairs(cpu.bodies);
        cpu.device->run({&pass, 1});
      }
    cuts = cpu.bodies.control.download().front().total_low[physics::reverted_vertices];
    motions.push_back(cpu.bodies.motions.download());
  }
  CHECK(cuts > 10);
  CHECK(motions[0] == motions[1]);
}

TEST_CASE("bodies that hook into each other gain no energy, however fast they fly, and keep momentum and turning") {
  for (const double along : {0.0, 20.0}) {
    CAPTURE(along);
    const ModelAndState start = ball_in_a_pocket({0, along, 0.3 * along});
    const auto device = make_cpu_device(1, 32);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.004}),
                          {.response = {"impulse"}, .gap = small_gap});
    const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 0.9);
    const double without_flight = 23.7;  // [J], kinetic energy at the start with none
    CHECK(seen.report.reverted_vertices > 1000);
    CHECK(seen.most - seen.first < 1e-3 * without_flight);
    CHECK(glm::length(seen.momentum) < 1e-4 * (1 + along));
    CHECK(glm::length(seen.turning_change) < 5e-3);
  }
}

// The light one catches on an edge of the heavy one, and both go on turning.
TEST_CASE("bodies that spin while they hook into each other gain no energy") {
  std::vector<BodySetup> setups = {soft(generate_mesh("cube:1"), "heavy"), soft(generate_mesh("cube:5"), "light")};
  setups[0].description.total_mass = 100;
  setups[0].description.total_stiffness = 1e7;
  setups[0].description.position = {0, 0.16, -0.1};
  setups[0].description.rotation = {264, 224, 3};
  setups[0].description.velocity = {36, 0, 0};
  setups[0].description.spin = {30, 30, 0};
  setups[1].description.total_stiffness = 1e5;
  setups[1].description.position = {3.6, 0.1, -0.26};
  setups[1].description.rotation = {153, 213, 308};
  setups[1].description.velocity = {-23, 0, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 64);
  const double stiffest = std::sqrt(1e5);  // [1/s] of either body
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1.3 / stiffest}),
                        {.response = {"impulse"}, .gap = small_gap});
  const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 1.2);
  CHECK(seen.report.reverted_vertices > 10000);
  CHECK(seen.most - seen.first < 1e-6 * seen.first);
  CHECK(seen.last < seen.first);
}

// Each crumples around the other, and most kicks do not settle from some 1,300 parts on. The trees are those of the table in
// docs/contact.md. With others contacts come in another order, and motions become others.
TEST_CASE("kicks that do not settle give no energy", "[long]") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:4")};
  const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = 2});
  const auto device = make_cpu_device(2, 32);
  CollisionDescription collision = by_impulses;
  collision.tree.split = TreeSplit::centre;
  Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"verlet", meeting.time_step}),
                        collision);
  const EnergySwing swing = energy_swing_of(simulation, meeting.start, 42, 64);
  CHECK(simulation.report().unsettled_contacts > 0);
  CHECK(swing.least < -0.5);
  CHECK(swing.most_rise < 1e-3);
}

TEST_CASE("a body that was cut short gives its momentum to what does not move, and only if it is beside that") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "ball"), soft(generate_mesh("cube:1"), "slab")};
  setups[0].description.velocity = {5, 0, 0};
  setups[0].description.spin = {0, 0, 3};
  setups[0].description.position = {0, 2.1, 0};
  setups[1].description.kind = BodyKind::immovable;
  setups[1].description.scale = 2;
  for (const bool is_beside : {false, true}) {
    CAPTURE(is_beside);
    setups[1].description.position.y = is_beside ? 0 : -10;
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    Bench cpu(make_cpu_device(1, 64), start, {"verlet", 0.02}, by_impulses);
    cpu.begin();
    for (const Pass& pass : cpu.step(0)) {
      cpu.device->run({&pass, 1});
      if (pass.name == "expect_cuts") cut_by_hand(cpu.bodies.arrays.get<std::uint32_t>("cut"), 8);
    }
    const bool owes = cpu.bodies.arrays.get<physics::Debt>("debt").download().back().energy > 0;
    CHECK(owes == !is_beside);  // it has no other motion to pay with
    const double momentum = bench::momentum_of(start.model, cpu.bodies.download(1)).x;
    if (is_beside)
      CHECK(momentum < 4.9);
    else
      CHECK(momentum == Approx(5).epsilon(1e-13));
    const ResponseReport given = cpu.collider.response()->report();
    CHECK(given.outside_impulse.x == Approx(momentum - 5).margin(1e-13));
  }
}

// Where a tolerance governs steps, one that is queued when the time is reached is empty.
TEST_CASE("bodies that hook into each other outlast empty steps") {
  const ModelAndState start = ball_in_a_pocket({0, 20, 6});
  const auto device = make_cpu_device(1, 32);
  std::vector<StepReport> reports;
  std::vector<std::vector<double>> ends;
  for (const int empty_steps : {0, 3}) {
    Simulation simulation(*device, start.model, start.state, plan_of(Adaptive{}, start.model),
                          {.response = {"impulse"}, .gap = small_gap});
    for (int stop = 1; stop <= 40; ++stop) {
      simulation.advance_to(0.0075 * stop);
      for (int k = 0; k < empty_steps; ++k) simulation.advance_part();
    }
    reports.push_back(simulation.report());
    ends.push_back(simulation.state().motion);
  }
  CHECK(reports[0].reverted_vertices > 50);
  CHECK(reports[1].time == reports[0].time);
  CHECK(reports[1].steps == reports[0].steps);
  CHECK(ends[1] == ends[0]);
}

TEST_CASE("paying for cuts gives the same bits on any number of threads, and after saving") {
  const CollisionDescription by_default = {.response = {"impulse"}, .gap = small_gap};
  const CollisionDescription without_bounce = {.response = {"impulse"}, .elasticity = 0, .friction = 0, .gap = small_gap};
  for (const SavedRun& run : {check_same_bits(ball_over_knob(3000, 0.12), {"verlet", 0.01}, without_bounce, 200, 260),
                              check_same_bits(ball_in_a_pocket({0, 20, 6}), {"verlet", 0.004}, by_default, 100, 160),
                              check_same_bits(pocket_before_wall(20, 2.6), {"verlet", 0.004}, by_default, 60, 120)}) {
    CHECK(run.saved.reverted_vertices > 0);
    CHECK(run.last.reverted_vertices > run.saved.reverted_vertices);
  }
}

TriangleMesh level_sheet(std::uint32_t squares) {
  TriangleMesh mesh;
  const std::uint32_t row = squares + 1;
  for (std::uint32_t i = 0; i < row * row; ++i)
    mesh.positions.push_back({i / row / static_cast<double>(squares) - 0.5, 0, i % row / static_cast<double>(squares) - 0.5});
  for (std::uint32_t i = 0; i < squares; ++i)
    for (std::uint32_t a = i * row; a < i * row + squares; ++a) {
      mesh.triangles.push_back({a, a + 1, a + row});
      mesh.triangles.push_back({a + 1, a + row + 1, a + row});
    }
  return mesh;
}

// It spreads, up to the block in the first step, while the ground pushes it up.
TEST_CASE("a sheet that begins far below a ground's gap does not pass into the block beside it") {
  std::vector<BodySetup> setups = {soft(level_sheet(4), "sheet"), soft(generate_mesh("cube:3"), "block")};
  setups[0].description.position = {0, 1e-5, 0};
  setups[0].description.stretch = {0.3, 1, 1};
  setups[1].description.kind = BodyKind::immovable;
  setups[1].description.position = {0.67, 0.02, 0.02};
  GroundDescription ground;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0), {&ground, 1});
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.7 / omega}),
                        {.response = {"impulse"}, .elasticity = 0});
  const bench::ApartOracle oracle(start.model);
  REQUIRE(oracle.pairs_not_apart(start.state.world_positions(start.model)) == 0);
  simulation.advance(1);
  CHECK(simulation.report().reverted_vertices > 0);
  CHECK(oracle.pairs_not_apart(simulation.state().world_positions(start.model)) == 0);
}

// Triangles that all run from one end of a diagonal of the unit cube to the other, so that the boxes of all of them overlap.
TriangleMesh ribbon(std::uint32_t triangles) {
  TriangleMesh mesh;
  for (std::uint32_t k = 0; k <= triangles / 2; ++k) {
    const glm::dvec3 across = 2e-4 * k * glm::dvec3(1, 1, -2);
    mesh.positions.push_back(across);
    mesh.positions.push_back(across + 1.0);
  }
  for (std::uint32_t k = 0; k < triangles; ++k) mesh.triangles.push_back({k, k + 1, k + 2});
  return mesh;
}

TEST_CASE("there is room for all pairs of triangles that two bodies of 800 can have, so none holds them") {
  std::vector<BodySetup> setups = {soft(ribbon(800), "left"), soft(ribbon(800), "right")};
  setups[0].description.velocity = {1, 0, 0};
  setups[1].description.position = {0.2, -0.2, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(2, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1e-4}), by_impulses);
  simulation.advance(2);
  CHECK(simulation.report().held_parts == 0);
  const double moved = (simulation.state().world_positions(start.model)[0] - start.state.world_positions(start.model)[0]).x;
  CHECK(moved == Approx(2e-4));
}

}  // namespace
}  // namespace pliant
