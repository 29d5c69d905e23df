// Bodies whose springs are summed by clusters move as others do.
#include "support/clustered_bodies.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "support/device_bench.hpp"

namespace pliant {
namespace {

// As a rule 15 times the error of forces after 200 radians. These are far fewer.
TEST_CASE("a clustered body moves as one with all springs, by every kind of method", "[gl]") {
  const ModelAndState start = deformed_sphere(3, "dent");
  for (const TestDevice& test : all_devices())
    for (const Method& method :
         {Method{"verlet", 0.2 / omega}, Method{"verlet", 0.2 / omega, DampingLaw::internal}, Method{"srkn11b", 0.2 / omega},
          Method{"rk4", 0.2 / omega, DampingLaw::constant}, Method{"cv8", 0.5 / omega, DampingLaw::adaptive}}) {
      CAPTURE(test.name, method.integrator);
      ModelAndState damped = start;
      if (method.law != DampingLaw::none) damped.model.bodies[0].damping = 1e-4;
      const std::uint64_t steps = 10;
      const State direct = evolve(*test.device, damped, method, steps);
      const State by_clusters = evolve(*test.device, clustered(damped), method, steps);
      const std::vector<glm::dvec3> exact = displacements_of(direct), near = displacements_of(by_clusters);
      CHECK(distance(near, exact) > 0);
      CHECK(distance(near, exact) < 5 * allowed_error * size_of(exact));
      CHECK(distance(near, displacements_of(start.state)) > 0.1 * size_of(exact));  // it has moved
    }
}

TEST_CASE("a clustered body goes on to the bit on any number of threads, and from a saved state", "[gl]") {
  const ModelAndState start = clustered(deformed_sphere(3, "flat"));  // which needs other lists at once
  const TimePlan plan = plan_of({"verlet", 0.1 / omega});
  std::vector<std::vector<double>> motions;
  for (const unsigned threads : {1u, 2u, 7u}) {
    const auto device = make_cpu_device(threads, 32);
    Simulation simulation(*device, start.model, start.state, plan, no_contacts);
    simulation.advance(150);
    motions.push_back(simulation.state().motion);
  }
  CHECK(std::ranges::count(motions, motions.front()) == 3);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation whole(*test.device, start.model, start.state, plan, no_contacts);
    whole.advance(20);
    whole.advance(130);
    for (const std::uint64_t steps : {0u, 20u, 64u, 70u}) {
      Simulation first(*test.device, start.model, start.state, plan, no_contacts);
      first.advance(steps);
      const std::string saved = first.save();
      Simulation second(*test.device, start.model, start.state, plan, no_contacts);
      second.restore(saved);
      second.advance(150 - steps);
      CHECK(second.state().motion == whole.state().motion);
      CHECK(second.report() == whole.report());
    }
    REQUIRE(whole.report().clusters->lists_made > 0);
  }
}

TEST_CASE("steps with a tolerance are checked after the same steps, however many are queued at a time") {
  const ModelAndState start = clustered(deformed_sphere(3, "flat"));
  Adaptive adaptive;
  adaptive.integrator = "dprkn8";
  const TimePlan plan = plan_of(adaptive, start.model);
  const auto device = make_cpu_device(2, 64);
  std::vector<std::vector<double>> motions;
  std::vector<ClusterReport> reports;
  for (const std::uint64_t at_once : {1u, 5u, 32u}) {
    Simulation simulation(*device, start.model, start.state, plan, no_contacts);
    while (simulation.report().time < 0.5) static_cast<void>(simulation.advance_toward(0.5, at_once));
    motions.push_back(simulation.state().motion);
    reports.push_back(*simulation.report().clusters);
  }
  CHECK(std::ranges::count(motions, motions.front()) == 3);
  CHECK(std::ranges::count(reports, reports.front()) == 3);
  CHECK(reports.front().checks > 1);
}

// Both are undamped. Verlet's energy swings with the steps, whatever the springs.
TEST_CASE("the energy of a clustered body drifts as that of all springs, and momenta are kept") {
  const auto device = make_cpu_device(2, 64);
  const ModelAndState start = deformed_sphere(4, "dent");
  const TimePlan plan = plan_of({"verlet", 0.2 / omega});
  ThreadPool pool(2);
  const auto drift_of = [&](const ModelAndState& body) {
    Simulation simulation(*device, body.model, body.state, plan, no_contacts);
    Meter meter(body.model);
    const double first = meter.measure(body.state, {0, 0, 0}, pool).energy();
    double drift = 0;
    for (int k = 0; k < 100; ++k) {
      simulation.advance(10);
      const Measurement now = meter.measure(simulation.state(), {0, 0, 0}, pool);
      drift = std::max(drift, std::abs(now.energy() / first - 1));
      CHECK(glm::length(now.momentum) < 1e-12 * omega);
      CHECK(glm::length(now.angular_momentum) < 1e-12 * omega);
    }
    return std::pair(drift, simulation.report());
  };
  const auto [of_all, direct_report] = drift_of(start);
  const auto [of_clusters, report] = drift_of(clustered(start));
  CHECK(of_all > 1e-3);
  CHECK(of_clusters == Approx(of_all).epsilon(0.1));
  CHECK_FALSE(direct_report.clusters.has_value());
  REQUIRE(report.clusters.has_value());
  CHECK(report.clusters->checks == 72);  // after each 14 steps, and one at the start
  CHECK(report.clusters->largest_error < 3 * allowed_error);
  CHECK(report.pair_interactions < direct_report.pair_interactions / 4);
}

// The clustered body's own solution is as smooth as that of all springs.
TEST_CASE("a method of order 8 has it with clusters, too") {
  const auto device = make_cpu_device(2, 64);
  const auto order_for = [&](const ModelAndState& start) {
    const auto at_end = [&](std::uint64_t steps) {
      return displacements_of(evolve(*device, start, {"cv8", 4.0 / omega / static_cast<double>(steps)}, steps));
    };
    const std::vector<glm::dvec3> exact = at_end(64);
    const double coarse = distance(at_end(8), exact), fine = distance(at_end(16), exact);
    CHECK(coarse < 1e-6 * size_of(exact));
    return std::log2(coarse / fine);
  };
  const ModelAndState start = deformed_sphere(3, "smooth 0.01");
  const double of_all = order_for(start), of_clusters = order_for(clustered(start));
  CHECK(of_all > 7.3);
  CHECK(of_clusters == Approx(of_all).margin(0.1));
}

TEST_CASE("energies of a body that goes over to all springs and comes back are those of the way it is summed") {
  ThreadPool pool(2);
  const ModelAndState start = clustered(deformed_sphere(2, "smooth 0.01"));
  State direct = start.state;
  ChangedSums all_springs;
  all_springs.are_direct = true;
  direct.changed_sums = {std::make_shared<const ChangedSums>(all_springs)};
  Meter meter(start.model);
  const double by_clusters = meter.measure(start.state, {0, 0, 0}, pool).elastic;
  const double of_all = measure(deformed_sphere(2, "smooth 0.01").model, start.state, {0, 0, 0}, pool).elastic;
  CHECK(meter.measure(direct, {0, 0, 0}, pool).elastic == of_all);
  CHECK(meter.measure(start.state, {0, 0, 0}, pool).elastic == by_clusters);
  CHECK(by_clusters != of_all);
  CHECK(by_clusters == Approx(of_all).epsilon(1e-3));
}

TEST_CASE("a state goes on where its body is clustered, and where it is not", "[gl]") {
  ModelAndState plain = deformed_sphere(3, "dent");
  const ModelAndState with_clusters = clustered(plain);
  const TimePlan plan = plan_of({"verlet", 0.1 / omega});
  for (const TestDevice& test : all_devices()) {
    Simulation direct(*test.device, plain.model, plain.state, plan, no_contacts);
    Simulation by_clusters(*test.device, with_clusters.model, with_clusters.state, plan, no_contacts);
    direct.advance(10);
    by_clusters.restore(direct.save());
    CHECK(by_clusters.report().pair_interactions == direct.report().pair_interactions);
    by_clusters.advance(10);
    direct.restore(by_clusters.save());
    direct.advance(10);
    CHECK_FALSE(direct.report().breakdown.has_value());
    CHECK(direct.report().steps == 30);
  }
}

TEST_CASE("a clustered body that breaks down halts, whatever checks were due", "[gl]") {
  const ModelAndState alone = clustered(deformed_sphere(3, "smooth 0.2"));
  ModelAndState above_ground = alone;
  GroundDescription ground;
  ground.point.y = -1.5;
  above_ground.model.grounds = build_model({}, {0, 0, 0}, {&ground, 1}).model.grounds;
  for (const TestDevice& test : all_devices())
    for (const ModelAndState& start : {alone, above_ground}) {
      CAPTURE(test.name, start.model.grounds.size());
      Simulation simulation(*test.device, start.model, start.state, plan_of({"verlet", 50 / omega}), {});
      REQUIRE((simulation.collider().response() != nullptr) == !start.model.grounds.empty());
      simulation.advance(300);
      const StepReport report = simulation.report();
      REQUIRE(report.breakdown.has_value());
      CHECK(report.steps < 300);
      simulation.advance(10);
      CHECK(simulation.report().steps == report.steps);
      CHECK(simulation.report().clusters->checks == report.clusters->checks);
    }
}

TEST_CASE("a clustered body with pressure falls on others and the floor, which move as they do beside all springs", "[gl]") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:3"), "large"), soft(generate_mesh("icosphere:1"), "small"),
                                   soft(generate_mesh("icosphere:2"), "far away")};
  setups[0].description.position = {0, 1.05, 0};
  setups[0].description.velocity = {0, -1, 0};
  setups[0].description.pressure = 20;
  setups[1].description.scale = 0.3;
  setups[1].description.position = {0, 2.4, 0};
  setups[1].description.velocity = {0, -2, 0};
  setups[2].description.position = {9, 2, 0};
  setups[2].description.stretch = {1.1, 1, 1};
  const GroundDescription floor;
  const ModelAndState start = build_model(setups, {0, -9.81, 0}, {&floor, 1});
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const TimePlan plan = plan_of({"verlet", 0.05 / omega, DampingLaw::internal});
    const ModelAndState with_clusters = clustered(start);
    Simulation simulation(*test.device, with_clusters.model, with_clusters.state, plan, by_impulses);
    Simulation all_springs(*test.device, start.model, start.state, plan, by_impulses);
    for (Simulation* one : {&simulation, &all_springs}) one->advance(test.name == "gpu" ? 60 : 150);
    CHECK_FALSE(simulation.report().breakdown.has_value());
    CHECK(simulation.report().contact_steps > 0);
    CHECK(simulation.intersections().pairs == 0);
    const State state = simulation.state(), direct = all_springs.state();
    for (const ModelBody& body : start.model.bodies) {
      glm::dvec3 way(0.0);  // from one body's centre to the other's
      for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
        way += state.world_position(start.model, i) - direct.world_position(start.model, i);
      CAPTURE(body.name);
      CHECK(glm::length(way) / body.vertex_count < (body.name == "far away" ? 1e-6 : 0.01));
    }
  }
}

TEST_CASE("a clustered body at rest, or in rigid motion, sums no springs and is not checked", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    ModelAndState start = clustered(sphere_of(2));
    set_velocities(start, [](const glm::dvec3&) { return glm::dvec3(1, 0, 0); });
    Simulation simulation(*test.device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
    simulation.advance(100);
    CHECK(simulation.report().clusters->checks == 0);
    CHECK(simulation.report().force_evaluations == 0);
    CHECK(simulation.report().forces_skipped > 99);
  }
}

TEST_CASE("which bodies are clustered follows from keys, size and device") {
  BodySetup setup = soft(generate_mesh("icosphere:4"), "sphere");
  const auto is_clustered = [&](ForceSum forces, std::optional<double> by, DeviceKind device) {
    setup.description.forces = forces;
    setup.description.force_tolerance = by;
    Model model = build_model({&setup, 1}, {0, 0, 0}).model;
    choose_force_sums(model, device);
    return model.bodies[0].is_clustered;
  };
  for (const DeviceKind device : {DeviceKind::cpu, DeviceKind::gpu}) {
    CHECK_FALSE(is_clustered(ForceSum::automatic, {}, device));
    CHECK_FALSE(is_clustered(ForceSum::direct, 1e-3, device));
    CHECK(is_clustered(ForceSum::clustered, {}, device));
  }
  CHECK(is_clustered(ForceSum::automatic, 1e-3, DeviceKind::cpu));
  CHECK_FALSE(is_clustered(ForceSum::automatic, 1e-6, DeviceKind::cpu));  // which takes more springs
  CHECK_FALSE(is_clustered(ForceSum::automatic, 1e-3, DeviceKind::gpu));  // 2,562 vertices are too few
  setup.mesh = generate_mesh("icosphere:5");
  CHECK(is_clustered(ForceSum::automatic, 1e-3, DeviceKind::gpu));
  setup.description.kind = BodyKind::immovable;
  CHECK_FALSE(is_clustered(ForceSum::clustered, {}, DeviceKind::cpu));
}

}  // namespace
}  // namespace pliant
