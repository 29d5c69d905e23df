// A whole step: contacts, response, determinism, and what happens when numbers go wrong.
#include "simulation/simulation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "collision/contacts/oracle.hpp"
#include "model/load_bodies.hpp"
#include "support/all_trees.hpp"
#include "support/collision_scene.hpp"
#include "support/has.hpp"
#include "support/scene_text.hpp"

namespace pliant {
namespace {

struct Outcome {
  State state;
  std::vector<glm::vec4> positions;
  StepReport report;
};

Outcome collide(Device& device, const ModelAndState& start, const Method& method, std::uint64_t steps,
                const CollisionDescription& collision = {}) {
  Simulation simulation(device, start.model, start.state, plan_of(method), collision);
  simulation.advance(steps);
  return {simulation.state(), simulation.world_positions(), simulation.report()};
}

const Method usual{"cv8", 0.01, DampingLaw::adaptive};

// Only vertices that touch are answered, so either search serves.
CollisionDescription reflected_by(ContactSearch search) { return {.response = {"reflect"}, .search = search}; }
const CollisionDescription reflected = reflected_by(ContactSearch::tree), impelled{.response = {"impulse"}};

bool same_bits(const std::vector<physics::Pose>& a, const std::vector<physics::Pose>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(physics::Pose)) == 0;
}

// For every vertex, whether brute force finds a triangle of it that touches another body.
std::vector<bool> touched_vertices(const Model& model, const std::vector<glm::uvec2>& pairs) {
  std::vector<bool> touched(model.vertex_count());
  for (const glm::uvec2& pair : pairs)
    for (const std::uint32_t triangle : {pair.x, pair.y})
      for (const std::uint32_t vertex : model.triangles[triangle]) touched[vertex] = true;
  return touched;
}

void check_thread_counts(int precision, const Method& method, const CollisionDescription& collision) {
  const ModelAndState start = build_model(colliding_spheres(), {0, -1, 0});
  const Outcome one = collide(*make_cpu_device(1, precision), start, method, 30, collision);
  CHECK(one.report.contact_steps > 5);
  for (const unsigned threads : {2u, 7u, 16u}) {
    CAPTURE(threads);
    const Outcome many = collide(*make_cpu_device(threads, precision), start, method, 30, collision);
    CHECK(many.state.motion == one.state.motion);
    CHECK(same_bits(many.state.poses, one.state.poses));
    CHECK(many.positions == one.positions);
    CHECK(many.report == one.report);
  }
}

TEST_CASE("the CPU gives the same bits on 1, 2, 7 and 16 threads") {
  for (const int precision : {32, 64})
    for (const char* integrator : {"cv8", "verlet"})
      for (const ContactSearch search : {ContactSearch::tree, ContactSearch::brute_force}) {
        CAPTURE(precision, integrator, static_cast<int>(search));
        for (const DampingLaw law : {DampingLaw::adaptive, DampingLaw::internal})
          check_thread_counts(precision, {integrator, 0.01, law}, reflected_by(search));
      }
}

TEST_CASE("two runs on the GPU give the same bits", "[gl]") {
  if (test::lacks_gl()) return;
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const Method damped_inside{"verlet", 0.01, DampingLaw::internal};
  for (const auto& [method, collision] :
       {std::pair(usual, impelled), std::pair(damped_inside, impelled), std::pair(usual, reflected)}) {
    CAPTURE(method.integrator, collision.response.value);
    const Outcome first = collide(*make_gpu_device(0), start, method, 30, collision);
    const Outcome second = collide(*make_gpu_device(0), start, method, 30, collision);
    CHECK(first.report.contact_steps > 5);
    CHECK(first.state.motion == second.state.motion);
    CHECK(same_bits(first.state.poses, second.state.poses));
    CHECK(first.positions == second.positions);
    CHECK(first.report.node_tests == second.report.node_tests);
  }
}

TEST_CASE("steps queued together and one by one give the same bits") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  for (const CollisionDescription& collision : {impelled, reflected}) {
    CAPTURE(collision.response.value);
    const Outcome together = collide(*device, start, usual, 25, collision);
    CHECK(together.report.contact_steps > 5);
    Simulation simulation(*device, start.model, start.state, plan_of(usual), collision);
    for (int step = 0; step < 25; ++step) {
      simulation.advance(1);
      static_cast<void>(simulation.intersections());  // looking changes nothing
    }
    CHECK(simulation.state().motion == together.state.motion);
    CHECK(simulation.report() == together.report);
  }
}

TEST_CASE("vertices in contact go back bit for bit with their velocity reversed and scaled, and no others", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CollisionDescription none, reflect = reflected;
    none.response = Named{"none"};
    reflect.elasticity = 0.7;
    Simulation simulation(*test.device, start.model, start.state, plan_of(usual), reflect);
    std::size_t reverted = 0;
    for (int step = 0; step < 12; ++step) {
      const auto before = simulation.world_positions();
      const State from = simulation.state();
      const Outcome free = collide(*test.device, {start.model, from}, usual, 1, none);
      simulation.advance(1);
      const auto marks = simulation.collider().touching().marks();
      const auto after = simulation.world_positions();
      const State to = simulation.state();
      for (std::size_t i = 0; i < marks.size(); ++i) {
        const bool marked = marks[i] == static_cast<std::uint32_t>(step + 1);
        reverted += marked;
        if (!marked) continue;
        CHECK(after[i] == before[i]);
        for (std::size_t k = 3; k < 6; ++k)
          CHECK(to.motion[6 * i + k] == Approx(-0.7 * free.state.motion[6 * i + k]).epsilon(1e-12));
      }
    }
    CHECK(reverted > 10);
    CHECK(simulation.report().reverted_vertices == reverted);
  }
}

// Bodies are at rest, so that a step moves nothing. Its marks are then the touched vertices. Some vertices have marks, some none.
StepReport check_marks(Device& device, const ModelAndState& start, const CollisionDescription& collision = reflected) {
  Simulation simulation(device, start.model, start.state, plan_of(usual), collision);
  const auto pairs = intersecting_pairs(start.model, simulation.world_positions(), TriangleTest::certified);
  CHECK(simulation.intersections().pairs == pairs.size());
  simulation.advance(1);
  CHECK(simulation.report().contact_pairs_max == pairs.size());
  const std::vector<bool> touched = touched_vertices(start.model, pairs);
  CHECK(std::count(touched.begin(), touched.end(), true) > 10);
  CHECK(std::count(touched.begin(), touched.end(), false) > 10);
  const auto marks = simulation.collider().touching().marks();
  for (std::size_t i = 0; i < marks.size(); ++i) CHECK((marks[i] == 1) == touched[i]);
  return simulation.report();
}

TEST_CASE("marked vertices are those of the triangles that brute force finds", "[gl]") {
  auto setups = colliding_spheres();
  for (BodySetup& setup : setups) {
    setup.description.velocity = setup.description.spin = glm::dvec3(0.0);
    setup.description.position.x *= 0.75;
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  // Sixteen threads of a GPU share a pair of leaves. The last of these sizes makes a body one leaf.
  for (const unsigned leaf_size : {4u, 1u, 33u, 129u, 1000u}) {
    CollisionDescription collision = reflected;
    collision.tree.leaf_size = leaf_size;
    for (const TestDevice& test : all_devices()) {
      CAPTURE(test.name, leaf_size);
      check_marks(*test.device, start, collision);
    }
  }
}

TEST_CASE("searching trees, however they are split, and searching all pairs simulate the same") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  const Outcome by_force = collide(*device, start, usual, 30, reflected_by(ContactSearch::brute_force));
  for (const TreeDescription& tree : test::all_trees()) {
    CAPTURE(tree.split, tree.fan_out, tree.refit);
    CollisionDescription collision = reflected;
    collision.tree = tree;
    collision.treelet_pair_capacity = tree.fan_out == 2 ? 3 : 1000;  // too short, or long enough
    const Outcome by_tree = collide(*device, start, usual, 30, collision);
    CHECK(by_tree.state.motion == by_force.state.motion);
    CHECK(by_tree.report.contact_pairs_max == by_force.report.contact_pairs_max);
    CHECK(by_tree.report.triangle_tests == by_force.report.triangle_tests);  // those whose boxes overlap
  }
}

TEST_CASE("both searches count the same contacts in the step that a body elsewhere goes non-finite") {
  std::vector<BodySetup> setups = colliding_spheres();
  setups[1].description.position.x -= 0.1;  // they touch in the first step
  setups.push_back(sphere(0));
  setups.back().description.position = {9, 0, 0};
  setups.back().description.stiffness = 1e300;
  setups.back().description.stretch = {1.1, 1, 1};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  const StepReport by_tree = collide(*device, start, usual, 3, reflected).report;
  const StepReport by_force = collide(*device, start, usual, 3, reflected_by(ContactSearch::brute_force)).report;
  CHECK(by_tree.breakdown);
  CHECK(by_tree.contact_steps == 1);
  CHECK(by_force.breakdown == by_tree.breakdown);
  CHECK(by_force.contact_steps == by_tree.contact_steps);
  CHECK(by_force.contact_pairs_max == by_tree.contact_pairs_max);
  CHECK(by_force.triangle_tests == by_tree.triangle_tests);
}

TEST_CASE("a crowd of more near pairs than one dispatch serves is searched completely", "[gl]") {
  std::vector<BodySetup> setups;
  for (int i = 0; i < 190; ++i) {
    BodySetup setup = sphere(0);
    setup.description.position = {0.01 * i, 0.013 * (i % 7), 0.007 * (i % 11)};
    setups.push_back(setup);
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  for (const ContactSearch search : {ContactSearch::tree, ContactSearch::brute_force})
    for (const TestDevice& test : all_devices()) {
      CAPTURE(test.name, static_cast<int>(search));
      Simulation simulation(*test.device, start.model, start.state, plan_of(usual), reflected_by(search));
      const auto pairs = intersecting_pairs(start.model, simulation.world_positions(), TriangleTest::certified);
      CHECK(simulation.intersections().pairs == pairs.size());
    }
}

TEST_CASE("pairs beyond the list's capacity are found a second time, and none is lost") {
  std::vector<BodySetup> setups;
  for (int i = 0; i < 200; ++i) {  // nested shells, each a little off the centre: boxes overlap everywhere, few faces touch
    BodySetup setup = sphere(0);
    setup.description.scale = 1 + 0.005 * i;
    setup.description.position = {0.004 * (i % 7), 0.003 * (i % 11), 0};
    setups.push_back(setup);
  }
  const StepReport report = check_marks(*make_cpu_device(2, 32), build_model(setups, {0, 0, 0}));
  CHECK(report.pairs_beyond_capacity > 0);
}

// With a capacity of 1 a search with n pairs has n - 1 beyond it, and 7 fewer with a capacity of 8, if n is that large.
TEST_CASE("a run whose list of leaf pairs is too short in most steps gives the bits of one with room for all", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  for (const TestDevice& test : all_devices())
    for (CollisionDescription collision : {impelled, reflected}) {
      CAPTURE(test.name, collision.response.value);
      const Outcome roomy = collide(*test.device, start, usual, 30, collision);
      CHECK(roomy.report.contact_steps > 5);
      CHECK(roomy.report.pairs_beyond_capacity == 0);
      std::vector<std::uint64_t> beyond;
      for (const std::uint32_t capacity : {1u, 8u}) {
        collision.leaf_pair_capacity = capacity;
        Outcome cramped = collide(*test.device, start, usual, 30, collision);
        CHECK(cramped.state.motion == roomy.state.motion);
        CHECK(same_bits(cramped.state.poses, roomy.state.poses));
        CHECK(cramped.positions == roomy.positions);
        beyond.push_back(std::exchange(cramped.report.pairs_beyond_capacity, 0));
        CHECK(cramped.report == roomy.report);
      }
      const std::uint64_t searches = roomy.report.steps + roomy.report.substeps;
      CHECK(beyond[1] > 10 * roomy.report.contact_steps);
      CHECK(beyond[0] >= beyond[1] + 7 * roomy.report.contact_steps);
      CHECK(beyond[0] <= beyond[1] + 7 * searches);
    }
}

TEST_CASE("bodies that have parted are no longer reported as touching", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  CollisionDescription none;
  none.response = Named{"none"};  // they pass through each other
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_of(usual), none);
    simulation.advance(15);
    CHECK(simulation.intersections().bodies == std::vector<std::uint32_t>{0, 1});
    simulation.advance(100);
    const Intersections apart = simulation.intersections();
    CHECK(apart.pairs == 0);
    CHECK(apart.bodies.empty());
  }
}

// The contacts of two bodies whose boxes overlap. Only two of their triangles come near: tip to tip along x, `gap` apart [m].
std::uint32_t contacts_at_gap(Device& device, float gap, const CollisionDescription& description) {
  const std::vector<glm::vec4> positions{{-1, -0.1f, 0, 1}, {-1, 0.1f, 0, 1}, {-gap, 0, 0, 1},  //
                                         {5, 5, 5, 1},      {6, 5, 5, 1},     {5, 6, 5, 1},     //
                                         {1, -0.1f, 0, 1},  {1, 0.1f, 0, 1},  {0, 0, 0, 1},     //
                                         {-5, -5, -5, 1},   {-6, -5, -5, 1},  {-5, -6, -5, 1}};
  std::vector<BodySetup> setups;
  for (std::size_t first : {0u, 6u}) {
    TriangleMesh mesh{{}, {{0, 1, 2}, {3, 4, 5}}};
    for (std::size_t i = first; i < first + 6; ++i) mesh.positions.emplace_back(positions[i]);
    setups.push_back(body_of_mesh(mesh));
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  DeviceBodies bodies(device, start.model, start.state);
  const Collider collider(bodies, start.model, description);
  bodies.world_positions.upload(positions);  // uploads the exact bits, because the model rounds
  bodies.prepare_search();
  const Pass bounding = collider.bounding_pass(0);
  device.run({&bounding, 1});
  device.run(collider.search_passes(0));
  const physics::Control control = bodies.control.download().front();
  CHECK(control.near_pair_count == 1);
  CHECK(control.count[physics::contact_pairs] == intersecting_pairs(start.model, positions, description.triangle_test).size());
  return control.count[physics::contact_pairs];
}

TEST_CASE("triangles whose boxes are apart do not touch, however near, in either search", "[gl]") {
  for (const ContactSearch search : {ContactSearch::tree, ContactSearch::brute_force})
    for (const TriangleTest triangle_test : {TriangleTest::certified, TriangleTest::moller})
      for (const TestDevice& test : all_devices()) {
        CAPTURE(test.name, static_cast<int>(search), static_cast<int>(triangle_test));
        CollisionDescription description = reflected_by(search);
        description.triangle_test = triangle_test;
        for (const float gap : {1e-7f, 2e-7f, 4e-7f, 8e-7f}) {
          CAPTURE(gap);
          CHECK(contacts_at_gap(*test.device, gap, description) == 0);
        }
        CHECK(contacts_at_gap(*test.device, -1e-3f, description) == 1);
      }
}

TEST_CASE("bodies that stay apart do no tree work") {
  auto setups = colliding_spheres();
  setups[0].description.position = {-0.8, -0.8, 0};  // so that their boxes overlap before the first step
  setups[1].description.position = {0.8, 0.8, 0};
  setups[0].description.velocity = {-50, 0, 0};
  setups[1].description.velocity = {50, 0, 0};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(usual), reflected);
  CHECK(simulation.intersections().pairs == 0);  // looking leaves nothing behind either
  simulation.advance(20);
  const StepReport report = simulation.report();
  CHECK(report.nodes_refitted == 0);
  CHECK(report.node_tests == 0);
  CHECK(report.body_pairs_skipped == 20);
  CHECK(report.refits_skipped == 40);
}

TEST_CASE("bodies that meet by impulses do no tree work while they are far apart, and a lone one no work for contacts at all") {
  auto setups = colliding_spheres();
  const ModelAndState one = built(setups[0]);
  const auto device = make_cpu_device(1, 32);
  for (const glm::dvec3& way : {glm::dvec3(4, 0, 0), glm::dvec3(9, 9, 0), glm::dvec3(-9, 9, 9)}) {
    setups[1].description.position = setups[0].description.position + way;
    const StepReport report = collide(*device, build_model(setups, {0, 0, 0}), usual, 20).report;
    CHECK(report.nodes_refitted == 0);
    CHECK(report.node_tests == 0);
  }
  Simulation lone(*device, one.model, one.state, plan_of(usual), CollisionDescription{});
  lone.advance(20);
  CHECK(lone.collider().response() == nullptr);
}

TEST_CASE("in each part of a step a body's tree is refitted or counted as skipped, and a hybrid refit leaves boxes alone") {
  auto setups = colliding_spheres();
  for (BodySetup& setup : setups) {
    setup.description.position *= 3;
    setup.description.velocity *= 20;  // so that steps fall into parts
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const auto device = make_cpu_device(1, 32);
  const auto run = [&](TreeRefit refit, std::uint32_t treelet_pair_capacity) {
    CollisionDescription collision;
    collision.tree.refit = refit;
    collision.treelet_pair_capacity = treelet_pair_capacity;
    Simulation simulation(*device, start.model, start.state, plan_of(usual), collision);
    simulation.advance(20);
    return std::pair(simulation.report(), nodes_of_a_search(simulation.collider()));
  };
  const auto [report, nodes] = run(TreeRefit::bottom_up, 1000);
  const std::uint64_t parts = report.steps + report.substeps;
  CHECK(report.steps == 20);
  CHECK(report.substeps > 0);
  CHECK(report.refits_skipped > 0);
  CHECK(report.refits_skipped % 2 == 0);  // of two bodies either both are another's partner or none is
  CHECK(report.refits_skipped < 2 * parts);
  CHECK(report.nodes_refitted == nodes * (parts - report.refits_skipped / 2));
  const StepReport hybrid = run(TreeRefit::hybrid, 1000).first, short_list = run(TreeRefit::hybrid, 1).first;
  CHECK(hybrid.refits_skipped == report.refits_skipped);
  CHECK((hybrid.nodes_refitted > 0 && hybrid.nodes_refitted < report.nodes_refitted));
  CHECK(short_list.refits_skipped == report.refits_skipped);
  CHECK(short_list.nodes_refitted > hybrid.nodes_refitted);
}

TEST_CASE("a step can be left between its parts, and goes on to the same bits, after saving too") {
  auto setups = colliding_spheres();
  for (BodySetup& setup : setups) {
    setup.description.position *= 3;
    setup.description.velocity *= 20;
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const auto device = make_cpu_device(1, 32);
  const auto made = [&] {
    return std::make_unique<Simulation>(*device, start.model, start.state, plan_of(usual), CollisionDescription{});
  };
  const auto whole = made(), left = made(), resumed = made();
  whole->advance(20);
  while (left->report().substeps == 0) left->advance(1, [] { return true; });
  const StepReport between = left->report();
  REQUIRE(between.steps < 20);
  REQUIRE(between.time != Approx(static_cast<double>(between.steps) * plan_of(usual).time_step).epsilon(1e-6));
  resumed->restore(left->save());
  for (Simulation* each : {left.get(), resumed.get()}) {
    each->advance(20 - each->report().steps);
    CHECK(each->report().steps == 20);
    CHECK(each->report().substeps == whole->report().substeps);
    CHECK(each->state().motion == whole->state().motion);
  }
}

TEST_CASE("a force evaluation counts every ordered pair of a body's vertices") {
  BodySetup setup = sphere(1);
  setup.description.stretch = {1.1, 1, 1};
  const ModelAndState start = built(setup);
  const auto device = make_cpu_device(1, 32);
  const StepReport cv8 = collide(*device, start, {"cv8", 0.01}, 7).report;
  CHECK(cv8.force_evaluations == 77);
  CHECK(cv8.pair_interactions == 77ull * 42 * 41);
  CHECK(collide(*device, start, {"verlet", 0.01}, 7).report.force_evaluations == 8);  // and the first step's own
}

TEST_CASE("a vertex that goes non-finite is named in the step that made it, and nothing moves after", "[gl]") {
  BodySetup first = sphere(0), second = sphere(0);
  second.description.name = "second";
  second.description.position = {5, 0, 0};
  second.description.stretch = {1.2, 1, 1};
  const std::vector<BodySetup> setups{first, second};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const double step = 40 / stiffest_omega(start.model);  // far beyond the bound
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_of({"rk4", step}), reflected);
    simulation.advance(1);
    std::uint64_t steps = 1;
    while (!simulation.report().breakdown && steps < 1000) simulation.advance(1), ++steps;
    const StepReport report = simulation.report();
    REQUIRE(report.breakdown);
    CHECK(report.breakdown->step == steps);
    CHECK(report.breakdown->body == 1);
    CHECK(report.breakdown->vertex < 12);
    const auto broken = simulation.world_positions();
    const bool finite = std::all_of(broken.begin() + 12, broken.end(), [](const glm::vec4& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    const State at = simulation.state();
    const bool state_finite = std::all_of(at.motion.begin() + 72, at.motion.end(), [](double x) { return std::abs(x) < 3e38; });
    CHECK_FALSE((finite && state_finite));
    simulation.advance(3);
    CHECK(simulation.report().steps == steps);
    CHECK(simulation.report().breakdown->step == steps);
  }
}

// What bodies of 42 vertices take on a device once they have moved [bytes].
std::size_t bytes_of_bodies(int layers) {
  const SceneDescription scene = load_text(
      "[[body]]\nmesh = \"icosphere:1\"\nspacing = [3, 3, 3]\nstretch = [1.05, 1, 1]\n"
      "count = [20, 25, " +
      std::to_string(layers) + "]\n");
  const ModelAndState start = build_model(load_bodies(scene), glm::dvec3(0));
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.01, DampingLaw::adaptive}), impelled);
  simulation.advance(1);
  CHECK(simulation.report().steps == 1);
  return device->allocated_bytes();
}

TEST_CASE("ten thousand bodies of 42 vertices take less than 300 MB, and half as many take about half") {
  const std::size_t all = bytes_of_bodies(20);
  CHECK(all < 300'000'000);
  CHECK(static_cast<double>(bytes_of_bodies(10)) < 0.6 * static_cast<double>(all));
}

TEST_CASE("the GPU's final state is the fp64 one for the smooth part of a collision scene", "[gl]") {
  if (test::lacks_gl()) return;
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const Method method{"cv8", 0.005, DampingLaw::adaptive};
  const std::uint64_t steps = 5;  // until just before the first contact
  const Outcome exact = collide(*make_cpu_device(2, 64), start, method, steps),
                gpu = collide(*make_gpu_device(0), start, method, steps);
  CHECK(exact.report.contact_steps == 0);
  const auto a = exact.state.world_positions(start.model), b = gpu.state.world_positions(start.model);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(glm::length(a[i] - b[i]) < 1e-5);
}

}  // namespace
}  // namespace pliant
