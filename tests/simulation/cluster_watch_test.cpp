// Errors of clustered bodies are found, and lists changed, until they are small.
#include "simulation/cluster_watch.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "bench/dense/exact_forces.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "support/clustered_bodies.hpp"
#include "support/device_bench.hpp"
#include "support/full_device.hpp"
#include "support/no_more_memory.hpp"

namespace pliant {
namespace {

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

}  // namespace
}  // namespace pliant
