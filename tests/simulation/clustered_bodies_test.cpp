// Bodies whose springs are summed by clusters move as others do, and are watched.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "bench/dense/deformations.hpp"
#include "bench/dense/exact_forces.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "mesh/generators.hpp"
#include "simulation/cluster_watch.hpp"
#include "support/device_bench.hpp"
#include "support/evolve.hpp"
#include "support/full_device.hpp"
#include "support/impulse_scene.hpp"
#include "support/no_more_memory.hpp"

namespace pliant {
namespace {

constexpr double allowed_error = 1e-3;

const CollisionDescription no_contacts = {.response = {"none"}};

ModelAndState sphere_of(int level, const std::vector<glm::dvec3>& displacements = {}) {
  ModelAndState start = build_model(std::vector{soft(generate_mesh("icosphere:" + std::to_string(level)), "sphere")}, {0, 0, 0});
  for (std::uint32_t i = 0; i < displacements.size(); ++i)
    for (int k = 0; k < 3; ++k)
      start.state.motion[physics::displacement_of(i) + static_cast<std::size_t>(k)] = displacements[i][k];
  return start;
}

std::vector<glm::dvec3> rest_of(const Model& model) {
  std::vector<glm::dvec3> rest;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) rest.push_back(model.rest_position(i));
  return rest;
}

// A sphere of radius 1 in one of the deformations of the suite `dense`.
ModelAndState deformed_sphere(int level, std::string_view name) {
  const ModelAndState sphere = sphere_of(level);
  for (const bench::Deformation& deformation : bench::deformations_of(rest_of(sphere.model)))
    if (deformation.name == name) return sphere_of(level, deformation.displacements);
  throw std::logic_error("no such deformation");
}

ModelAndState clustered(ModelAndState start, std::size_t body = 0) {
  start.model.bodies[body].forces = ForceSum::clustered;
  start.model.bodies[body].force_tolerance = allowed_error;
  start.model.bodies[body].is_clustered = true;
  return start;
}

std::vector<glm::dvec3> displacements_of(const State& state) {
  std::vector<glm::dvec3> displacements;
  for (std::uint32_t i = 0; i < state.motion.size() / physics::motion_size; ++i) displacements.push_back(state.displacement(i));
  return displacements;
}

double size_of(const std::vector<glm::dvec3>& vectors) { return distance(vectors, std::vector(vectors.size(), glm::dvec3(0.0))); }

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

// A host sums with the same lists as the device says it has, and all springs. The device's own sums are in the first check of the
// next run: its motion is that of a body that has these lists from the start.
TEST_CASE("a body that is crushed or poked through has small errors at every check, or goes over to all springs") {
  const auto device = make_cpu_device(2, 32);
  ThreadPool pool(2);
  for (const char* name : {"flat", "poke"}) {
    const ModelAndState start = clustered(deformed_sphere(4, name));
    const std::vector<glm::dvec3> rest = rest_of(start.model);
    const TimePlan plan = plan_of({"verlet", 0.1 / omega});
    Simulation simulation(*device, start.model, start.state, plan, no_contacts);
    int checks = 0;
    for (; checks < 24 && simulation.report().clusters->direct.empty(); ++checks) {
      simulation.advance(29);  // up to the next check
      const State state = simulation.state();
      const std::optional<ListBasis> basis = list_basis_of(start.model.bodies[0], state.changed_sums[0].get());
      if (!basis) break;
      CAPTURE(name, checks);
      const ClusterSprings springs(rest, basis->accuracy, basis->displacements);
      const std::vector<glm::dvec3> displacements = displacements_of(state), forces = springs.forces(pool, displacements);
      const bench::ExactForces exact(pool, rest, displacements, 300);
      CHECK(exact.error_of([&](std::size_t i) { return forces[i]; }) < 3 * allowed_error);
      Simulation other(*device, start.model, state, plan, no_contacts);
      other.advance(1);
      Simulation same(*device, start.model, start.state, plan, no_contacts);
      same.restore(simulation.save());
      same.advance(1);
      CHECK(distance(displacements_of(other.state()), displacements_of(same.state())) < 1e-6 * size_of(displacements));
    }
    CHECK(checks > 0);
    CHECK(simulation.report().clusters->lists_made > 0);
    CHECK(simulation.energy_changed_by_lists() > 0);
  }
}

TEST_CASE("a state from before lists changed is gone back to, with the same bits, counts and energies") {
  const auto device = make_cpu_device(2, 32);
  ThreadPool pool(2);
  const ModelAndState start = clustered(deformed_sphere(4, "flat"));
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
  simulation.advance(64);
  const std::string saved = simulation.save();
  const StepReport before = simulation.report();
  const double changed_before = simulation.energy_changed_by_lists();
  Meter meter(start.model);
  const double energy = meter.measure(simulation.state(), {0, 0, 0}, pool).elastic;
  simulation.advance(300);
  const StepReport after = simulation.report();
  const double changed_after = simulation.energy_changed_by_lists();
  const std::vector<double> motion = simulation.state().motion;
  REQUIRE(after.clusters->lists_made > before.clusters->lists_made);
  static_cast<void>(meter.measure(simulation.state(), {0, 0, 0}, pool));
  simulation.restore(saved);
  CHECK(simulation.report() == before);
  CHECK(simulation.energy_changed_by_lists() == changed_before);
  CHECK(meter.measure(simulation.state(), {0, 0, 0}, pool).elastic == energy);
  simulation.advance(300);
  CHECK(simulation.report() == after);
  CHECK(simulation.energy_changed_by_lists() == changed_after);
  CHECK(simulation.state().motion == motion);
}

TEST_CASE("other lists change a body's energy by what the energies by both say, or nobody knows by how much if memory runs out") {
  const ModelAndState start = clustered(deformed_sphere(4, "dent"));
  const ModelBody& body = start.model.bodies[0];
  const std::vector<glm::dvec3> rest = rest_of(start.model), moved = displacements_of(start.state);
  const double accuracy = accuracy_of(allowed_error);
  const auto finer = std::make_shared<const ChangedSums>(ChangedSums{.accuracy = 0.1 * accuracy, .displacements = moved});
  const auto tree_of = [](const std::vector<glm::dvec3>& points) {
    return std::make_shared<const ClusterTree>(make_cluster_tree(points));
  };
  ThreadPool pool(1);
  const double before = ClusterSprings(rest, accuracy).energy(pool, moved);
  const double after = ClusterSprings(rest, 0.1 * accuracy, moved).energy(pool, moved);
  const double change = energy_change_of(body, tree_of(rest), 1, nullptr, finer, rest, moved);
  CHECK(change > 0);
  CHECK(energy_change_of(body, tree_of(rest), 1, finer, nullptr, rest, moved) == change);
  CHECK(change == Approx(body.stiffness * std::abs(after - before)).epsilon(1e-6));
#ifdef PLIANT_CAN_RUN_OUT_OF_MEMORY
  // Lists would take a quarter of most_list_entries, which is 256 MB.
  std::vector<glm::dvec3> in_one_place(1u << 17, glm::dvec3(1.0)), unmoved(in_one_place.size());
  const auto tree = tree_of(in_one_place);
  const test::NoMoreMemory tight;
  CHECK(std::isnan(energy_change_of(body, tree, 1, nullptr, nullptr, std::move(in_one_place), std::move(unmoved))));
#endif
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

TEST_CASE("of two clustered bodies one goes over to all springs, and the other moves as if it were alone", "[gl]") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:3"), "first"), soft(generate_mesh("icosphere:4"), "second"),
                                   soft(generate_mesh("icosphere:1"), "small")};
  for (std::size_t b = 0; b < setups.size(); ++b) setups[b].description.position.x = 4 * static_cast<double>(b);
  setups[2].description.stretch = {1.1, 1, 1};
  ModelAndState start = clustered(clustered(build_model(setups, {0, 0, 0}), 0), 1);
  start.model.bodies[1].force_tolerance = 1e-4;
  const auto deform = [&](std::size_t b, int level, std::string_view name) {
    const State deformed = deformed_sphere(level, name).state;
    std::ranges::copy(deformed.motion,
                      start.state.motion.begin() + std::ptrdiff_t{physics::motion_size} * start.model.bodies[b].first_vertex);
  };
  deform(0, 3, "smooth 0.01");
  deform(1, 4, "dephased 0.03");
  const ModelAndState alone = clustered(deformed_sphere(3, "smooth 0.01"));
  for (const TestDevice& test : all_devices())
    for (const Method& method : {Method{"verlet", 0.1 / omega}, Method{"cv8", 0.1 / omega}}) {
      CAPTURE(test.name, method.integrator);
      Simulation all(*test.device, start.model, start.state, plan_of(method), no_contacts);
      Simulation one(*test.device, alone.model, alone.state, plan_of(method), no_contacts);
      for (Simulation* simulation : {&all, &one}) simulation->advance(3);
      CHECK(all.report().clusters->direct == std::vector<std::uint32_t>{1});
      const std::vector<double> motion = one.state().motion, of_all = all.state().motion;
      CHECK(std::equal(motion.begin(), motion.end(), of_all.begin()));
    }
}

// Neighbours that move apart at random leave an error that no lists take away.
TEST_CASE("a body whose vertices scatter too much goes over to all springs, and then moves as one that had them", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    ModelAndState start = clustered(deformed_sphere(4, "dephased 0.03"));
    start.model.bodies[0].force_tolerance = 1e-4;
    const TimePlan plan = plan_of({"verlet", 0.1 / omega});
    Simulation simulation(*test.device, start.model, start.state, plan, no_contacts);
    simulation.advance(10);
    REQUIRE(simulation.report().clusters->direct == std::vector<std::uint32_t>{0});
    const State direct = evolve(*test.device, deformed_sphere(4, "dephased 0.03"), {"verlet", 0.1 / omega}, 10);
    CHECK(distance(displacements_of(simulation.state()), displacements_of(direct)) <
          1000 * test.rounding * size_of(displacements_of(direct)));
    Simulation again(*test.device, start.model, start.state, plan, no_contacts);
    again.restore(simulation.save());
    simulation.advance(20);
    again.advance(20);
    CHECK(again.state().motion == simulation.state().motion);
  }
}

// The flat sphere needs other lists at once. Some of their arrays are there when memory runs out.
TEST_CASE("a body goes over to all springs where a device has no room for other lists, and then moves as one that had them") {
  const ModelAndState start = clustered(deformed_sphere(4, "flat"));
  const Method method{"verlet", 0.1 / omega};
  const std::vector<glm::dvec3> direct =
      displacements_of(evolve(*make_cpu_device(2, 64), deformed_sphere(4, "flat"), method, 10));
  for (const DeviceKind kind : {DeviceKind::cpu, DeviceKind::gpu}) {
    test::FullDevice device(make_cpu_device(2, 64));
    Simulation simulation(device, start.model, start.state, plan_of(method), no_contacts);
    device.refuse_beyond(3 * sizeof(double) * start.model.vertex_count(), kind);  // enough for all springs
    simulation.advance(10);
    REQUIRE(simulation.report().clusters->direct == std::vector<std::uint32_t>{0});
    CHECK(simulation.report().clusters->lists_made == 0);
    CHECK(distance(displacements_of(simulation.state()), direct) < 1e-12 * size_of(direct));
  }
}

TEST_CASE("lists that miss the tolerance by little stay if others do no better") {
  const auto device = make_cpu_device(2, 64);
  ModelAndState start = clustered(deformed_sphere(4, "dephased 0.03"));
  start.model.bodies[0].force_tolerance = 4e-4;
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
  simulation.advance(1);
  const ClusterReport report = *simulation.report().clusters;
  CHECK(report.largest_excess > 1);
  CHECK(report.largest_excess <= 2);
  CHECK(report.direct.empty());
  CHECK(report.lists_made == 0);
  CHECK(simulation.energy_changed_by_lists() == 0);
  const State state = simulation.state();
  REQUIRE(state.changed_sums[0]);
  CHECK(state.changed_sums[0]->are_strained);
  CHECK(state.changed_sums[0]->changes == 0);
  CHECK(state.changed_sums[0]->displacements.empty());
}

TEST_CASE("more exact lists are made for 0.7 times the tolerance, or are the finest") {
  const auto next = [](double excess, bool aims = true) { return next_accuracy(1e-7, excess, 1e-8, aims); };
  const double double_error = accuracy_of(2e-3) / accuracy_of(1e-3);  // what makes errors twice as large
  CHECK(next(1.4).value() == Approx(1e-7 / double_error));
  CHECK(next(0.7 * std::pow(4.9, 1 / 1.75)).value() == Approx(1e-7 / 4.9));
  CHECK(next(0.7 * std::pow(5.1, 1 / 1.75)).value() == 1e-8);
  CHECK(next(std::numeric_limits<double>::infinity()).value() == 1e-8);
  CHECK(next(1.4, false).value() == 1e-8);
  CHECK_FALSE(next_accuracy(1e-8, 1.4, 1e-8, true));
}

TEST_CASE(
    "lists become more exact by what their error asks for, a body's later ones become the finest, and so do those that miss") {
  const auto device = make_cpu_device(2, 64);
  // Returns the accuracy of lists after a check, over that of the first lists.
  const auto share_for = [&](const char* deformation, double tolerance, std::uint32_t changes = 0, double share = 1) {
    ModelAndState start = clustered(deformed_sphere(4, deformation));
    start.model.bodies[0].force_tolerance = tolerance;
    const double standard = accuracy_of(tolerance);
    if (changes > 0)
      start.state.changed_sums = {std::make_shared<const ChangedSums>(
          ChangedSums{.changes = changes, .accuracy = share * standard, .displacements = {}})};
    Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
    simulation.advance(1);
    const ClusterReport report = *simulation.report().clusters;
    CHECK(report.largest_excess <= 1);
    CHECK(report.lists_made == 1);
    const State state = simulation.state();
    REQUIRE(state.changed_sums[0]);
    CHECK(state.changed_sums[0]->changes == changes + 1);
    return state.changed_sums[0]->accuracy / standard;
  };
  const double largest_aimed_share = std::pow(0.7, 1.75);  // asked for where lists hardly miss the tolerance
  for (const std::uint32_t changes : {0u, 3u}) {
    const double share = share_for("poke", 5e-4, changes);
    CHECK(share > 0.2);
    CHECK(share < largest_aimed_share);
  }
  CHECK(share_for("poke", 5e-4, 4) == Approx(0.1));
  CHECK(share_for("flat", 5e-4, 4) == Approx(1));  // lists as exact as before do for the shape
  CHECK(share_for("poke", 2e-4) == Approx(0.1));
  CHECK(share_for("poke", 2e-4, 1, 0.3) == Approx(0.1));
  CHECK(share_for("dephased 0.03", 5.5e-4) == Approx(0.1));  // lists that should suit do not, because rough shapes err more
}

TEST_CASE("a report names the body whose forces were off the most") {
  std::vector<BodySetup> setups;
  for (const char* name : {"first", "pressed most", "last"}) setups.push_back(soft(generate_mesh("icosphere:3"), name));
  ModelAndState start = clustered(clustered(clustered(build_model(setups, {0, 0, 0})), 1), 2);
  for (const ModelBody& body : start.model.bodies) {
    const std::vector<glm::dvec3> rest = start.model.rest_positions_of(body);
    const double pressed = body.name == "pressed most" ? 0.5 : 0.1;
    for (std::uint32_t i = 0; i < rest.size(); ++i)
      start.state.motion[physics::displacement_of(body.first_vertex + i) + 1] = -pressed * rest[i].y;
  }
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
  simulation.advance(1);
  const ClusterReport report = *simulation.report().clusters;
  CHECK(report.checks == 3);
  REQUIRE((report.lists_made == 0 && report.direct.empty() && report.largest_excess <= 1));  // errors of the first lists count
  CHECK(report.worst_body == 1);
}

TEST_CASE("a body whose lists have changed as often as they may goes over to all springs") {
  const auto device = make_cpu_device(2, 32);
  const auto changed_before = [&](std::uint32_t changes) {
    ModelAndState start = clustered(deformed_sphere(4, "flat"));
    start.state.changed_sums = {std::make_shared<const ChangedSums>(
        ChangedSums{.changes = changes, .accuracy = accuracy_of(allowed_error), .displacements = {}})};
    Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.1 / omega}), no_contacts);
    simulation.advance(1);
    return simulation.report().clusters.value();
  };
  const ClusterReport once_more = changed_before(7), no_more = changed_before(8);
  CHECK(once_more.lists_made == 1);
  CHECK(once_more.largest_excess <= 1);  // no step has had the lists from before
  CHECK(once_more.direct.empty());
  CHECK(no_more.lists_made == 0);
  CHECK(no_more.direct == std::vector<std::uint32_t>{0});
}

TEST_CASE("where steps fall into parts a clustered body is checked between the same steps, made whole or part by part") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:3"), "large"), soft(generate_mesh("icosphere:1"), "small")};
  setups[1].description.position = {2.3, 0, 0};
  setups[1].description.velocity = {-20, 0, 0};
  const ModelAndState start = clustered(build_model(setups, {0, 0, 0}));
  const auto device = make_cpu_device(2, 32);
  const TimePlan plan = plan_of({"verlet", 0.5 / omega, DampingLaw::internal});
  Simulation whole(*device, start.model, start.state, plan, by_impulses);
  Simulation by_parts(*device, start.model, start.state, plan, by_impulses);
  whole.advance(33);
  while (by_parts.report().steps < 33) by_parts.advance_part();  // no check is due after 33
  const StepReport report = whole.report();
  CHECK(report.substeps > 0);
  CHECK(report.clusters->checks > 2);
  CHECK(by_parts.report() == report);
  CHECK(by_parts.state().motion == whole.state().motion);
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
