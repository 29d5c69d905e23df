// Contact by impulses: bodies stay apart, and momentum and energy are what they should be. bench/contact/apart.hpp
// proves the first in another way.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "bench/contact/encounter.hpp"
#include "bench/contact/meeting.hpp"
#include "support/collision_scene.hpp"
#include "support/device_bench.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

// Runs by steps of a fixed length.
bench::Seen watch(Device& device, const ModelAndState& start, const Method& method, std::uint64_t steps,
                  const CollisionDescription& collision = by_impulses) {
  Simulation simulation(device, start.model, start.state, plan_of(method), collision);
  return bench::watch(simulation, start, {.steps = steps});
}

// Runs by steps that a tolerance governs.
bench::Seen watch(Device& device, const ModelAndState& start, const Adaptive& method, double duration) {
  Simulation simulation(device, start.model, start.state, plan_of(method, start.model), by_impulses);
  return bench::watch_for(simulation, start, duration);
}

// How much rounding changes the momentum of bodies that vibrate as much, without contact, over the sum of m |v| at the start. It
// is a random walk, so the longest of four counts. Steps have the mean length of those seen.
double momentum_change_alone(Device& device, const ModelAndState& start, const bench::Seen& seen, const Adaptive& method) {
  const double time_step = seen.report.time / static_cast<double>(seen.report.steps);
  Simulation simulation(device, start.model, seen.most_deformed, plan_of(Method{method.integrator, time_step}),
                        {.response = {"none"}});
  double most = 0;
  for (int walk = 0; walk < 4; ++walk)
    most = larger(most, bench::most_change_of_momentum(simulation, start.model, seen.report.steps, {}));
  return most / bench::sum_of_momenta(start.model, start.state);
}

// Spheres that meet off their centres, with this part of an edge a step against each other.
ModelAndState meeting_spheres(int level, double edges_a_step, double time_step) {
  std::vector<BodySetup> setups;
  for (const double side : {-1.0, 1.0}) {
    BodySetup& setup =
        setups.emplace_back(soft(generate_mesh("icosphere:" + std::to_string(level)), side < 0 ? "left" : "right"));
    setup.description.position = {1.1 * side, 0.15 * side, 0.05};
    setup.description.rotation = {10 * side, 20, 0};  // symmetric pairs would be decided by rounding
    setup.description.velocity = {-0.5 * side * edges_a_step * (1.1 / (1 << level)) / time_step, 0, 0};
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("a body that only a ground can touch has a tree of one node, and falls on it as beside another body far away") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:2"), "ball"), soft(generate_mesh("icosphere:2"), "far")};
  setups[1].description.position = {100, 0, 0};
  GroundDescription ground;
  ground.point = {0, -1.02, 0};
  const auto motion_of_ball = [&](std::size_t count) {
    const ModelAndState start = build_model({setups.data(), count}, {0, -5, 0}, {&ground, 1});
    const auto device = make_cpu_device(1, 32);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.1 / omega}), by_impulses);
    CHECK((simulation.collider().forest().nodes.size() == 1) == (count == 1));
    simulation.advance(60);
    CHECK(simulation.report().contact_steps > 0);
    const State state = simulation.state();
    std::vector<glm::dvec3> positions = state.world_positions(start.model);
    positions.resize(start.model.bodies[0].vertex_count);
    return positions;
  };
  const std::vector<glm::dvec3> by_itself = motion_of_ball(1), with_other = motion_of_ball(2);
  double most = 0;
  for (std::size_t i = 0; i < by_itself.size(); ++i) most = larger(most, glm::distance(by_itself[i], with_other[i]));
  CHECK(most < 1e-9);  // not in bits
}

TEST_CASE("spheres that meet at any speed stay apart, part again and keep momentum") {
  const double time_step = 0.5 / omega;
  for (const int precision : {64, 32}) {
    const auto device = make_cpu_device(1, precision);
    for (const double speed : {0.05, 0.2, 1.0, 20.0}) {
      CAPTURE(precision, speed);
      const bench::Seen seen = watch(*device, meeting_spheres(1, speed, time_step), Method{"cv8", time_step}, 100);
      CHECK(seen.touching == 0);
      CHECK(seen.inside == 0);
      CHECK(seen.report.contact_steps > 0);
      CHECK(seen.momentum_change < (precision == 64 ? 1e-14 : 1e-8));
      CHECK(seen.most_energy < 1e-3);
      CHECK(seen.last_energy < 1e-6);
      if (speed < 0.25) CHECK(seen.report.reverted_vertices == 0);
      if (speed > 1) CHECK(seen.report.substeps > 8);
    }
  }
}

TEST_CASE("long steps fall into parts while bodies touch, so that impacts make no energy") {
  const auto device = make_cpu_device(1, 64);
  for (const double omega_step : {1.0, 1.2, 1.9}) {
    for (const double elasticity : {0.0, 1.0}) {
      CAPTURE(omega_step, elasticity);
      const double time_step = omega_step / omega;
      const bench::Seen seen = watch(*device, meeting_spheres(1, 0.05, time_step), Method{"cv8", time_step}, 60,
                                     {.response = {"impulse"}, .elasticity = elasticity});
      CHECK(seen.most_energy < 1e-3);
      CHECK(seen.report.substeps > 0);
    }
  }
}

// Springs press a surface on as it bounces. An impulse that threw it back as fast as it will come on average would give energy.
TEST_CASE("surfaces with an elasticity of 1 make no energy") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:2")};
  for (const double omega_step : {0.5, 1.2}) {
    for (const double edges_a_step : {0.05, 0.2}) {
      CAPTURE(omega_step, edges_a_step);
      const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = edges_a_step, .omega_step = omega_step});
      const auto device = make_cpu_device(1, 64);
      const bench::Seen seen = watch(*device, meeting.start, Method{"cv8", meeting.time_step}, 120,
                                     {.response = {"impulse"}, .elasticity = 1, .friction = 0});
      CHECK(seen.report.contact_steps > 10);
      if (omega_step < 1) CHECK(seen.most_energy < 1e-3);
      CHECK(seen.last_energy < 1e-6);
    }
  }
}

// A body of 1 kg between two of this mass [kg], which come along y.
ModelAndState squeezed(double mass) {
  std::vector<BodySetup> setups;
  const double masses[] = {mass, 1, mass}, heights[] = {-2.3, 0, 2.2};
  for (int k = 0; k < 3; ++k) {
    BodySetup& setup = setups.emplace_back(soft(generate_mesh("icosphere:1"), k == 0 ? "lower" : k == 1 ? "light" : "upper"));
    setup.description.position = {0.03 * (1 - k), heights[k], 0.1 * (k == 1 ? 1 : -0.5)};
    setup.description.velocity = {0, 3.0 * (1 - k), 0};
    setup.description.total_mass = masses[k];
    setup.description.total_stiffness = k == 1 ? 100 : 900 * masses[k];
  }
  return build_model(setups, glm::dvec3(0.0));
}

// One contact throws the light body back into another one, which gives energy if each is answered by its own velocities alone.
TEST_CASE("a light body that is squeezed between heavier ones gains no energy") {
  for (const double mass : {10.0, 100.0}) {
    for (const double elasticity : {0.5, 0.9, 1.0}) {
      CAPTURE(mass, elasticity);
      const ModelAndState start = squeezed(mass);
      const auto device = make_cpu_device(1, 64);
      const bench::Seen seen =
          watch(*device, start, Method{"cv8", 0.2 / 30}, 225, {.response = {"impulse"}, .elasticity = elasticity, .friction = 0});
      CHECK(seen.report.contact_steps > 10);
      CHECK(seen.touching == 0);
      CHECK(seen.most_energy < 1e-3);
    }
  }
}

struct Squeeze {
  ModelAndState start;
  double time_step;
  std::uint64_t steps;
  CollisionDescription collision;
};

// A body of 1 kg between two others, all else by chance, or with this friction.
Squeeze random_squeeze(std::uint32_t seed, std::optional<double> given_friction = {}) {
  std::mt19937 random(seed);
  const auto part = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const auto between = [&](double low, double high) { return low + (high - low) * part(); };
  const auto by_magnitude = [&](double low, double high) { return low * std::pow(high / low, part()); };
  double elasticity = between(0, 1);
  const double by_chance = std::array{0.0, 0.3, 1.0, 3.0, 10.0, 100.0}[random() % 6];
  const double friction = given_friction.value_or(by_chance);
  const std::uint32_t common_one = random() % 4;
  if (common_one < 2) elasticity = common_one == 0 ? 1.0 : 0.7;
  const double below = by_magnitude(1, 100), above = by_magnitude(1, 100), speed = by_magnitude(0.5, 8);
  const double omega_step = between(0.1, 0.6);
  const std::array masses{below, 1.0, above}, heights{-2.3, 0.0, between(2.2, 2.4)};
  std::vector<BodySetup> setups;
  double fastest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    BodySetup& setup = setups.emplace_back(soft(generate_mesh("icosphere:1"), k == 0 ? "lower" : k == 1 ? "light" : "upper"));
    const double x = between(-0.2, 0.2), z = between(-0.2, 0.2), omega_squared = 1000 * by_magnitude(0.1, 10);
    setup.description.position = {x, heights[k], z};
    setup.description.velocity = {0, speed * (1 - static_cast<double>(k)), 0};
    setup.description.total_mass = masses[k];
    setup.description.total_stiffness = masses[k] * omega_squared;
    fastest = larger(fastest, std::sqrt(omega_squared));
  }
  const double time_step = omega_step / fastest;
  return {build_model(setups, glm::dvec3(0.0)),
          time_step,
          static_cast<std::uint64_t>(std::min(6 / speed / time_step, 400.0)),
          {.response = {"impulse"}, .elasticity = elasticity, .friction = friction}};
}

// In a jam impulses grow from round to round. Of 1,500 random squeezes these were found to gain energy, as a part of the kinetic
// one, if
// - what a contact gives at least does not shrink: 2240 (0.02), 1818
// - contacts that have not settled bounce: 1595 (0.03)
// - both: 1796 (1.3), 1109, 1818
// - friction shrinks from its coefficient, and not from what is used: 1548 (3.7), 2496, with a coefficient of 1e8
TEST_CASE("contacts with elasticity and friction that jam make no energy") {
  struct Case {
    std::uint32_t seed;
    std::optional<double> friction;
  };
  for (const auto& [seed, friction] :
       {Case{1109, {}}, Case{1595, {}}, Case{1796, {}}, Case{1818, {}}, Case{2240, {}}, Case{1548, 1e8}, Case{2496, 1e8}}) {
    CAPTURE(seed);
    const Squeeze squeeze = random_squeeze(seed, friction);
    const auto device = make_cpu_device(1, 64);
    const bench::Seen seen = watch(*device, squeeze.start, Method{"cv8", squeeze.time_step}, squeeze.steps, squeeze.collision);
    CHECK(seen.report.contact_steps > 10);
    CHECK(seen.touching == 0);
    CHECK(seen.most_energy < 1e-3);
  }
}

// Some contacts hardly need an impulse of their own, but get large ones where the light body is pressed against the ground.
TEST_CASE("no contact bounces by more than what stopped it and the elasticity's part of that") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:2"), "light"), soft(generate_mesh("icosphere:2"), "heavy")};
  setups[0].description.position = {-0.0389, 1.1, 0.0527};
  setups[0].description.total_stiffness = 1e4;
  setups[1].description.position = {-0.1974, 3.3, -0.0542};
  setups[1].description.velocity = {0, -10, 0};
  setups[1].description.total_mass = 10;
  setups[1].description.total_stiffness = 9000;
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0), {&ground, 1});
  const auto device = make_cpu_device(1, 64);
  const bench::Seen seen =
      watch(*device, start, Method{"cv8", 0.002}, 400, {.response = {"impulse"}, .elasticity = 0.3, .friction = 0.5});
  CHECK(seen.report.contact_steps > 100);
  CHECK(seen.most_energy < 1e-3);
}

// In fp32 rounding makes the momentum walk at random, and walks differ: a mean counts.
TEST_CASE("steps that a tolerance governs keep bodies apart, too, and a kick is undone with its step") {
  for (const int precision : {64, 32}) {
    const auto device = make_cpu_device(1, precision);
    double change = 0, change_alone = 0;
    for (const double speed : {0.02, 0.5, 8.0, 9.0, 10.0, 10.5, 11.0, 12.0}) {
      CAPTURE(precision, speed);
      const ModelAndState start = meeting_spheres(1, speed, 0.5 / omega);
      const Adaptive method{.tolerance = precision == 64 ? 1e-9 : 1e-5};
      const bench::Seen seen = watch(*device, start, method, 100 * 0.5 / omega);
      CHECK(seen.touching == 0);
      CHECK(seen.inside == 0);
      CHECK(seen.report.contact_steps > 0);
      if (speed > 1) CHECK(seen.report.adaptive->rejected > 0);  // slow ones foresee all
      CHECK(seen.most_energy < 1e-3);
      if (precision == 64) CHECK(seen.momentum_change < 1e-14);
      if (precision == 64) continue;
      const double alone_change = momentum_change_alone(*device, start, seen, method);
      CHECK(seen.momentum_change < 5 * alone_change);
      change += seen.momentum_change * speed;  // as momenta
      change_alone += alone_change * speed;
    }
    CHECK(change <= 1.5 * change_alone);
  }
}

TEST_CASE("with a tolerance the bits do not depend on how many steps are queued at a time") {
  const auto device = make_cpu_device(1, 64);
  const ModelAndState start = meeting_spheres(1, 0.2, 0.5 / omega);
  const double duration = 40 * 0.5 / omega;
  std::vector<StepReport> reports;
  std::vector<std::vector<double>> ends;
  for (const std::uint64_t at_once : {1, 7, 1000}) {
    Simulation simulation(*device, start.model, start.state, plan_of(Adaptive{}, start.model), by_impulses);
    for (int stop = 1; stop <= 40; ++stop)
      while (simulation.report().time < stop * duration / 40) simulation.advance_toward(stop * duration / 40, at_once);
    reports.push_back(simulation.report());
    ends.push_back(simulation.state().motion);
  }
  CHECK(reports[0].contact_steps > 0);
  for (const std::size_t other : {1, 2}) {
    CHECK(ends[other] == ends[0]);
    CHECK(reports[other].contact_steps == reports[0].contact_steps);
  }
}

TEST_CASE("bodies that vibrate wildly after an impact fly on freely, with long steps, too") {
  const auto device = make_cpu_device(1, 64);
  const double time_step = 1.8 / omega;
  const ModelAndState start = meeting_spheres(1, 1, time_step);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", time_step}), by_impulses);
  simulation.advance(12);
  const bench::ApartOracle oracle(start.model);
  REQUIRE(simulation.report().contact_steps > 0);
  REQUIRE(oracle.have_parted(simulation.state().world_positions(start.model)));
  const std::uint64_t cut = simulation.report().reverted_vertices;
  simulation.advance(100);
  CHECK(simulation.report().reverted_vertices == cut);
}

// The step is 0.8 of the bound on it, so that a vertex goes on by more than could be expected of it.
TEST_CASE("bodies that vibrate wildly as they pass each other keep momentum, and their motion") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:2"), "left"), soft(generate_mesh("icosphere:1"), "right")};
  setups[0].description.stretch = {1.26, 0.69, 1.06};
  setups[0].description.velocity = {0.5, 5, 0};
  setups[0].description.spin = {-1, 0.5, -1.5};
  setups[1].description.stretch = {1.59, 0.69, 1.23};
  setups[1].description.velocity = {-0.5, -5, 0};
  setups[1].description.spin = {3.2, 0.3, -7.5};
  setups[1].description.position = {3.35, 0, 0};
  setups[1].description.total_stiffness = 3 * total_stiffness;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.03}), by_impulses);
  const bench::Seen seen = bench::watch(simulation, start, {.steps = 40});
  CHECK(seen.momentum_change < 1e-13);
  CHECK(seen.report.response.outside_impulse == glm::dvec3(0.0));
  CHECK(seen.report.contact_steps == 0);
  CHECK(seen.report.reverted_vertices == 0);
}

TEST_CASE("jammed contacts with strong friction make no energy") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:2")};
  for (const double friction : {3.0, 10.0}) {
    for (const double edges_a_step : {0.5, 1.0}) {
      CAPTURE(friction, edges_a_step);
      const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = edges_a_step});
      const auto device = make_cpu_device(1, 64);
      Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"cv8", meeting.time_step}),
                            {.response = {"impulse"}, .elasticity = 0.5, .friction = friction});
      const EnergySwing swing = energy_swing_of(simulation, meeting.start, 50, 8);
      const ResponseReport contacts = simulation.report().response;
      CHECK(contacts.energy_given < 0.03 * contacts.energy_taken);  // if they did not lose friction, it would be 0.08 and more
      CHECK(swing.least < -0.2);
      CHECK(swing.most_rise < 1e-4);
    }
  }
}

TEST_CASE("bodies pay at once for what contacts that did not settle gave, as far as they can") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:2")};
  ThreadPool pool(1);
  int payments = 0;
  for (const double friction : {50.0, 100.0, 1000.0}) {
    CAPTURE(friction);
    const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = 0.3});
    Bench cpu(make_cpu_device(1, 64), meeting.start, {"cv8", meeting.time_step},
              {.response = {"impulse"}, .elasticity = 0, .friction = friction});
    cpu.begin();
    const auto energy_at = [&](std::uint32_t half) {
      return measure(meeting.start.model, cpu.bodies.download(half), glm::dvec3(0.0), pool).kinetic;
    };
    const auto owed = [&] { return cpu.bodies.arrays.get<physics::Debt>("debt").download().back().energy; };
    for (std::uint32_t step = 0; step < 400; ++step) {
      const std::uint32_t half = 1 - (step & 1);
      for (const Pass& pass : cpu.step(step & 1)) {
        const bool pays = pass.name == "pay_dues";
        const double before = pays ? energy_at(half) : 0, owed_before = pays ? owed() : 0;
        cpu.device->run({&pass, 1});
        if (!pays || cpu.bodies.control.download().front().count[physics::reverted_vertices] > 0) continue;
        const std::vector<double> total = cpu.bodies.arrays.get<double>("contact_total").download();
        const double due = total[physics::unsettled_energy_of(0)] + total[physics::unsettled_energy_of(1)];
        if (due > 0) ++payments;
        CHECK(before - energy_at(half) == Approx(due + owed_before - owed()).margin(1e-12 * before));
      }
    }
  }
  CHECK(payments > 0);
}

TEST_CASE("spheres that dent each other by edges part again, and hardly a motion is cut short") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:3")};
  const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = 1.3});
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"verlet", meeting.time_step}),
                        by_impulses);
  for (int part = 0; part < 900; ++part) simulation.advance_part();
  const StepReport report = simulation.report();
  CHECK(report.contact_steps > 300);
  CHECK(report.held_parts == 0);
  CHECK(report.reverted_vertices < 50);  // of 1,155,600 motions
  CHECK(bench::ApartOracle(meeting.start.model).have_parted(simulation.state().world_positions(meeting.start.model)));
}

// A device's roundings can let a contact bounce a step sooner, which changes all that comes after. That may happen in some
// encounters.
TEST_CASE("contact by impulses gives the same bits on any number of threads, and the same motion on a GPU", "[gl]") {
  const double time_step = 0.5 / omega;
  int same_motions = 0;
  for (const double edges_a_step : {0.02, 0.03, 0.04, 0.05, 0.06}) {
    CAPTURE(edges_a_step);
    const ModelAndState start = meeting_spheres(2, edges_a_step, time_step);
    const auto state_on = [&](Device& device) {
      Simulation simulation(device, start.model, start.state, plan_of(Method{"verlet", time_step}), by_impulses);
      simulation.advance(100);
      CHECK(simulation.report().contact_steps > 10);
      return simulation.state();
    };
    const State expected = state_on(*make_cpu_device(1, 32));
    for (const unsigned threads : {2u, 3u}) CHECK(state_on(*make_cpu_device(threads, 32)).motion == expected.motion);
    if (test::lacks_gl()) return;
    const std::vector<glm::dvec3> positions = expected.world_positions(start.model);
    const std::vector<glm::dvec3> on_gpu = state_on(*make_gpu_device(0)).world_positions(start.model);
    double largest = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) largest = larger(largest, glm::length(on_gpu[i] - positions[i]));
    if (largest < 1e-6) ++same_motions;
    CHECK(largest < 0.02);
  }
  CHECK(same_motions >= 3);
}

// Bits differ, because leaves decide which triangle has an edge, and contacts are rounded about its corner. In fp32 that can let
// a contact bounce a step sooner.
TEST_CASE("contact by impulses gives the same motion however many triangles a leaf has") {
  const double time_step = 0.5 / omega;
  const ModelAndState start = meeting_spheres(2, 0.1, time_step);
  const auto places_by = [&](unsigned leaf_size) {
    CollisionDescription collision = by_impulses;
    collision.tree.leaf_size = leaf_size;
    const auto device = make_cpu_device(1, 64);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", time_step}), collision);
    simulation.advance(60);
    CHECK(simulation.report().contact_steps > 10);
    return simulation.state().world_positions(start.model);
  };
  const std::vector<glm::dvec3> expected = places_by(4);
  for (const unsigned leaf_size : {1u, 32u, 33u, 1000u}) {
    const std::vector<glm::dvec3> places = places_by(leaf_size);
    double largest = 0;
    for (std::size_t i = 0; i < places.size(); ++i) largest = larger(largest, glm::length(places[i] - expected[i]));
    CAPTURE(leaf_size);
    CHECK(largest < 1e-12);
  }
}

TEST_CASE("bodies that begin nearer than the gap part slowly, however short steps are") {
  const auto device = make_cpu_device(1, 64);
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "left"), soft(generate_mesh("icosphere:1"), "right")};
  setups[1].description.position = {2.0002, 0, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto distance_of_corners = [&](const State& state) {  // along x
    double left = -10, right = 10;
    const std::vector<glm::dvec3> places = state.world_positions(start.model);
    for (std::size_t i = 0; i < places.size(); ++i)
      start.model.body_index(static_cast<std::uint32_t>(i)) == 0 ? void(left = std::max(left, places[i].x))
                                                                 : void(right = std::min(right, places[i].x));
    return right - left;
  };
  ThreadPool pool(1);
  for (const double time_step : {2e-3, 2e-4, 2e-5}) {
    CAPTURE(time_step);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", time_step}), by_impulses);
    simulation.advance(static_cast<std::uint64_t>(0.02 / time_step));
    CHECK(measure(start.model, simulation.state(), glm::dvec3(0.0), pool).energy() < 1e-3);
    CHECK(distance_of_corners(simulation.state()) > 1.5 * distance_of_corners(start.state));
  }
}

// Two spheres that meet, and maybe a heavy one that flies by far away.
ModelAndState meeting_in_front_of(bool has_passer) {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "left"), soft(generate_mesh("icosphere:1"), "right")};
  for (const double side : {-1.0, 1.0}) {
    BodyDescription& body = setups[side < 0 ? 0 : 1].description;
    body.position = {1.1 * side, 0.15 * side, 0.05};
    body.velocity = {-3 * side, 0, 0};
  }
  if (has_passer) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "passer"));
    setups[2].description.position = {0, 1e8, 0};
    setups[2].description.velocity = {1e6, 0, 0};
    setups[2].description.total_mass = 1e15;
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("a body that touches nothing changes nothing for others, however heavy and fast it is") {
  for (const std::optional<double> restitution : {std::optional<double>(), std::optional(0.5)}) {
    std::vector<std::vector<double>> motions;
    std::vector<double> energies;
    for (const bool has_passer : {false, true}) {
      const ModelAndState start = meeting_in_front_of(has_passer);
      const auto device = make_cpu_device(1, 64);
      Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.01}),
                            {.response = {"impulse"}, .elasticity = 0.5, .restitution = restitution});
      simulation.advance(60);
      const std::size_t of_both = 2 * physics::motion_size * start.model.bodies[0].vertex_count;
      motions.push_back(simulation.state().motion);
      motions.back().resize(of_both);
      energies.push_back(simulation.report().response.energy_taken);
    }
    CHECK(energies[0] > 1);
    CHECK(energies[1] == energies[0]);
    CHECK(motions[1] == motions[0]);
  }
}

}  // namespace
}  // namespace pliant
