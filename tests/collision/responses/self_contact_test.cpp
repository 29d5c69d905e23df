// Bodies that meet themselves: their surfaces do not pass through themselves, however they are wrung, pressed flat or turned
// inside out. Where nothing touches, nothing changes.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "collision/collider.hpp"
#include "mesh/generators.hpp"
#include "simulation/overlap.hpp"
#include "simulation/start_check.hpp"
#include "support/all_trees.hpp"
#include "support/device_bench.hpp"
#include "support/expect_error.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

BodySetup meeting_itself(TriangleMesh mesh, bool self_contact = true) {
  BodySetup setup = soft(std::move(mesh), "body");
  setup.description.self_contact = self_contact;
  return setup;
}

// How the ends of a bar along y turn against each other [rad/s a metre], and its sides come together [1/s].
struct Wringing {
  double turning, pressing;
};

void wring(ModelAndState& start, const Wringing& by) {
  set_velocities(start, [&](const glm::dvec3& x) {
    return by.turning * x.y * glm::cross(glm::dvec3(0, 1, 0), x) - glm::dvec3(by.pressing * x.x, 0, 0);
  });
}

constexpr const char* bar = "box:0.5,2,0.5,12";

ModelAndState wrung_bar(const Wringing& by, bool self_contact) {
  const BodySetup setup = meeting_itself(generate_mesh(bar), self_contact);
  ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
  wring(start, by);
  return start;
}

std::uint64_t own_pairs(Simulation& simulation, const Model& model) {
  return own_contacts(model, model.bodies.front(), simulation.state().world_positions(model), 64).touching;
}

// How a body without gravity goes on.
struct Course {
  std::uint64_t most_pairs = 0;              // of its triangles that touched, at any look
  double first_energy = 0, most_energy = 0;  // [J]
  double momentum_change = 0;                // over the sum of its vertices' at the start
  StepReport report;
};

Course course_of(Device& device, const ModelAndState& start, const Method& method, int looks, std::uint64_t steps_between) {
  Simulation simulation(device, start.model, start.state, plan_of(method), by_impulses);
  Course seen;
  ThreadPool pool(1);
  const Measurement before = measure(start.model, start.state, glm::dvec3(0.0), pool);
  seen.first_energy = seen.most_energy = before.energy();
  double all_momentum = 0;
  for (std::uint32_t i = 0; i < start.model.vertex_count(); ++i)
    all_momentum += start.model.body_of(i).vertex_mass * glm::length(start.state.world_velocity(start.model, i));
  for (int look = 0; look < looks; ++look) {
    simulation.advance(steps_between);
    const Measurement now = measure(start.model, simulation.state(), glm::dvec3(0.0), pool);
    seen.most_energy = larger(seen.most_energy, now.energy());
    seen.momentum_change = larger(seen.momentum_change, glm::length(now.momentum - before.momentum) / all_momentum);
    seen.most_pairs = std::max(seen.most_pairs, own_pairs(simulation, start.model));
  }
  seen.report = simulation.report();
  return seen;
}

TEST_CASE("a bar that is wrung and pressed together does not pass through itself, and makes no energy and no momentum") {
  for (const int precision : {32, 64})
    for (const Wringing& by : {Wringing{30, 0}, Wringing{0, 40}, Wringing{30, 20}}) {
      CAPTURE(precision, by.turning, by.pressing);
      const auto device = make_cpu_device(2, precision);
      const Method method{"cv8", 0.01, DampingLaw::none};
      const ModelAndState start = wrung_bar(by, true);
      const Course met = course_of(*device, start, method, 30, 2);
      CHECK(met.most_pairs == 0);
      CHECK(met.report.contact_steps > 0);
      CHECK(met.report.held_parts == 0);
      CHECK(met.report.reverted_vertices * 100 <= met.report.contact_steps * start.model.vertex_count());
      CHECK(met.most_energy <= met.first_energy * (1 + 1e-3));
      CHECK(met.momentum_change < (precision == 64 ? 1e-13 : 1e-6));
      CHECK(course_of(*device, wrung_bar(by, false), method, 30, 2).most_pairs > 0);
    }
}

TEST_CASE("a ring that is crushed does not pass through itself, on every device", "[gl]") {
  for (const TestDevice& test : all_devices())
    for (const bool self_contact : {true, false}) {
      CAPTURE(test.name, self_contact);
      const BodySetup setup = meeting_itself(generate_mesh("ring:0.3,8"), self_contact);
      ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
      wring(start, {60, 100});
      const Course seen = course_of(*test.device, start, {"verlet", 0.01, DampingLaw::none}, 12, 1);
      CHECK((seen.most_pairs == 0) == self_contact);
      CHECK((seen.report.contact_steps > 0) == self_contact);
    }
}

// A ball without gravity and damping that a ground stops.
ModelAndState falling_ball(double speed, bool self_contact) {
  BodySetup setup = meeting_itself(generate_mesh("icosphere:2"), self_contact);
  setup.description.position = {0, 1.2, 0};
  setup.description.velocity = {0, -speed, 0};
  return build_model({&setup, 1}, glm::dvec3(0.0), std::array{GroundDescription()});
}

double volume(const Model& model, const State& state) {
  const std::vector<glm::dvec3> x = state.world_positions(model);
  double sum = 0;
  for (const auto& [a, b, c] : model.triangles) sum += glm::dot(x[a], glm::cross(x[b], x[c])) / 6;
  return sum;
}

TEST_CASE("a ball that falls at twice r omega is flattened, and does not turn inside out") {
  const auto device = make_cpu_device(2, 32);
  for (const bool self_contact : {true, false}) {
    const ModelAndState start = falling_ball(2 * omega, self_contact);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.3 / omega}), by_impulses);
    double least = 1;
    std::uint64_t most_pairs = 0;
    for (int look = 0; look < 60; ++look) {
      simulation.advance(1);
      least = std::min(least, volume(start.model, simulation.state()) / volume(start.model, start.state));
      most_pairs = std::max(most_pairs, own_pairs(simulation, start.model));
    }
    CAPTURE(self_contact, least, most_pairs);
    CHECK(least < 0.5);
    CHECK((least > 0) == self_contact);
    CHECK((most_pairs == 0) == self_contact);
  }
}

// The largest difference of two motions, in [m] and [m/s].
double difference(const State& a, const State& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.motion.size(); ++k) most = larger(most, std::abs(a.motion[k] - b.motion[k]));
  return most;
}

// The first step of a ring falls into parts, because it is no star.
TEST_CASE("a body that does not touch itself moves as it would without self-contact, and a star to the bit") {
  for (const TestDevice& test : all_devices())
    for (const char* mesh : {"icosphere:1", "ring:0.3,8"}) {
      CAPTURE(test.name, mesh);
      State last[2];
      for (const bool self_contact : {false, true}) {
        const BodySetup setup = meeting_itself(generate_mesh(mesh), self_contact);
        ModelAndState start = build_model({&setup, 1}, {0, -9.81, 0});
        set_velocities(start, [](const glm::dvec3& x) { return glm::dvec3(3 - 4 * x.y, 2 * x.x, 3 * x.z); });
        Simulation simulation(*test.device, start.model, start.state, plan_of(Method{"cv8", 0.01}), by_impulses);
        simulation.advance(10);
        last[self_contact ? 1 : 0] = simulation.state();
        CHECK(simulation.report().contact_steps == 0);
        CHECK(simulation.report().reverted_vertices == 0);
      }
      CHECK(difference(last[0], last[1]) < 1e-4);
      if (std::string_view(mesh).starts_with("icosphere")) CHECK((last[0].motion == last[1].motion));
    }
}

TEST_CASE("a thin plate turns with self-contact as without, though its sides are near each other") {
  State last[2];
  for (const bool self_contact : {false, true}) {
    BodySetup setup = meeting_itself(generate_mesh("box:1,1,0.01,1"), self_contact);
    setup.description.spin = {6, 6, 0};
    const ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
    const auto device = make_cpu_device(1, 32);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 1.0 / 60}), by_impulses);
    simulation.advance(60);
    last[self_contact ? 1 : 0] = simulation.state();
    CHECK(simulation.report().reverted_vertices == 0);
  }
  CHECK(difference(last[0], last[1]) < 1e-4);
}

TEST_CASE("a fine thin plate at rest is not held in its first step") {
  const BodySetup setup = meeting_itself(generate_mesh("box:1,1,0.01,28"));
  const ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1.0 / 60}), by_impulses);
  simulation.advance(2);
  CHECK(simulation.report().held_parts == 0);
  CHECK(simulation.report().reverted_vertices == 0);
}

TEST_CASE("a body that begins out of shape is not cut short") {
  for (const char* mesh : {"ring:0.3,32", "icosphere:2"}) {
    CAPTURE(mesh);
    BodySetup setup = meeting_itself(generate_mesh(mesh));
    setup.description.stretch = {1.5, 1, 1};
    const ModelAndState start = build_model({&setup, 1}, {0, -9.81, 0});
    const auto device = make_cpu_device(2, 32);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.5 / omega}), by_impulses);
    simulation.advance(10);
    CHECK(simulation.report().reverted_vertices == 0);
  }
}

TEST_CASE("a body that another one wakes does not pass through itself") {
  BodySetup ring = meeting_itself(generate_mesh("ring:0.3,12"));
  ring.description.position = {0, 0.31, 0};
  ring.description.damping = 0.3;
  BodySetup ball = soft(generate_mesh("icosphere:1"), "ball");
  ball.description.scale = 0.5;
  ball.description.total_mass = 20;
  ball.description.position = {1, 60, 0};
  const std::array setups = {ring, ball};
  ModelAndState start = build_model(setups, {0, -9.81, 0}, std::array{GroundDescription()});
  TimePlan plan = plan_of(Method{"verlet", 0.01, DampingLaw::internal});
  plan.sleep = true;
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan, by_impulses);
  bool slept = false, woke = false;
  std::uint64_t touching = 0;
  for (int look = 0; look < 90; ++look) {
    simulation.advance(5);
    const bool sleeps = simulation.report().bodies_asleep > 0;
    woke = woke || (slept && !sleeps);
    slept = slept || sleeps;
    touching += own_pairs(simulation, start.model);
  }
  CHECK((slept && woke));
  CHECK(touching == 0);
  CHECK(simulation.report().held_parts == 0);
}

TEST_CASE("steps by a tolerance keep a bar out of itself, too") {
  const ModelAndState start = wrung_bar({30, 20}, true);
  const auto device = make_cpu_device(2, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Adaptive{}, start.model), by_impulses);
  std::uint64_t touching = 0;
  for (double time = 0.02; time < 0.3; time += 0.02) {
    simulation.advance_to(time);
    touching += own_pairs(simulation, start.model);
  }
  CHECK(touching == 0);
  CHECK(simulation.report().contact_steps > 0);
}

TEST_CASE("a wrung bar ends in the same bits on any number of threads, and when it was saved") {
  const SavedRun run = check_same_bits(wrung_bar({30, 20}, true), {"cv8", 0.01, DampingLaw::none}, by_impulses, 25, 50);
  CHECK(run.last.contact_steps > run.saved.contact_steps);
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// Pairs of triangles whose corners' cages overlap, in leaf order, as a search found them and by comparing each with each.
struct Listed {
  Pairs found, expected;
  std::size_t count = 0;  // in the list
};

// The box around the cages of a triangle's corners.
physics::Box box_of_cages(std::span<const glm::vec2> cages, std::span<const std::uint32_t> corners) {
  physics::Box box = physics::empty_box();
  for (const std::uint32_t corner : corners) {
    const glm::vec2* at = &cages[physics::cage_of(corner)];
    box.lower = glm::min(box.lower, glm::vec3(at[0], at[1].x));
    box.upper = glm::max(box.upper, glm::vec3(at[1].y, at[2]));
  }
  return box;
}

Listed listed_by(std::unique_ptr<Device> device, const ModelAndState& start, const TreeDescription& tree) {
  CollisionDescription collision = by_impulses;
  collision.tree = tree;
  Bench bench(std::move(device), start, {"cv8", 0.01, DampingLaw::none}, collision);
  bench.begin();
  for (const Pass& pass : bench.step(0)) {
    if (pass.name == "find_contacts") break;
    bench.device->run({&pass, 1});
  }
  const Arrays& arrays = bench.bodies.arrays;
  Listed pairs;
  pairs.count = arrays.get<physics::ContactList>("contact_list").download().front().triangle_pair_count;
  for (const glm::uvec2& pair : arrays.get<glm::uvec2>("triangle_pair").download(0, pairs.count))
    pairs.found.insert(std::minmax({pair.x, pair.y & ~physics::ways_meet}));
  const std::vector<std::uint32_t> corners = arrays.get<std::uint32_t>("triangle").download();
  const std::vector<glm::vec2> cages = arrays.get<glm::vec2>("cage").download();
  std::vector<physics::Box> boxes;
  for (std::uint32_t t = 0; t < corners.size() / 3; ++t) {
    boxes.push_back(box_of_cages(cages, std::span(corners).subspan(std::size_t{3} * t, 3)));
    for (std::uint32_t s = 0; s < t; ++s)
      if (physics::overlaps(boxes[s], boxes[t])) pairs.expected.emplace(s, t);
  }
  return pairs;
}

TEST_CASE("every two triangles of a body whose cages overlap are listed once, by trees of every kind") {
  const BodySetup setup = meeting_itself(generate_mesh("ring:0.3,16"));
  ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
  wring(start, {0, 40});
  for (const TreeDescription& tree : test::all_trees())
    for (TestDevice& test : all_devices()) {
      CAPTURE(test.name, tree.fan_out, static_cast<int>(tree.split));
      const Listed pairs = listed_by(std::move(test.device), start, tree);
      CHECK(pairs.count == pairs.expected.size());
      CHECK((pairs.found == pairs.expected));
    }
}

TEST_CASE("a body that intersects itself at the start is an error that counts the pairs") {
  TriangleMesh two = generate_mesh("icosphere:1");  // and another one that intersects it
  const auto vertices = static_cast<std::uint32_t>(two.positions.size());
  const TriangleMesh one = two;
  for (const glm::dvec3& p : one.positions) two.positions.push_back(p + glm::dvec3(0.5, 0.1, 0.2));
  for (auto corners : one.triangles) {
    for (std::uint32_t& corner : corners) corner += vertices;
    two.triangles.push_back(corners);
  }
  const BodySetup setup = meeting_itself(two);
  const ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.01}), by_impulses);
  const std::uint64_t pairs =
      own_contacts(start.model, start.model.bodies[0], start.state.world_positions(start.model), 32).touching;
  CHECK(pairs > 10);
  check_says(error_of([&] {
               expect_apart(simulation, start.model, by_impulses, "scene.toml");
               return 0;
             }),
             {"scene.toml", "\"body\"", ("in " + std::to_string(pairs) + " pairs").c_str()});
}

TEST_CASE("a body that is too near itself for proofs in fp32 is an error, and higher precision is its remedy") {
  TriangleMesh sheets{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2e-7}, {1, 0, 2e-7}, {0, 1, 2e-7}}, {{0, 1, 2}, {3, 5, 4}}};
  const BodySetup setup = meeting_itself(std::move(sheets));
  ModelAndState start = build_model({&setup, 1}, glm::dvec3(0.0));
  for (const int precision : {32, 64}) {
    const auto device = make_cpu_device(1, precision);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.01}), by_impulses);
    const auto check = [&] {
      expect_apart(simulation, start.model, by_impulses, "scene.toml");
      return 0;
    };
    if (precision == 64)
      CHECK(check() == 0);
    else
      check_says(error_of(check), {"too near itself", "fp32", "in 1 pair of triangles", "--precision 64"});
  }
}

TEST_CASE("a bar is wrung and pressed flat between plates for ten thousand steps, and does not pass through itself", "[long]") {
  BodySetup setup = meeting_itself(generate_mesh(bar));
  setup.description.damping = 0.2;
  const auto plate_at = [](double side) {
    BodySetup p = body_of_mesh(generate_mesh("box:0.2,3,2,6"));
    p.description.name = side < 0 ? "left" : "right";
    p.description.kind = BodyKind::scripted;
    p.description.repeats = true;
    p.description.path = {{0, {side * 1.2, 0, 0}, {}}, {2, {side * 0.16, 0, 0}, {}}, {4, {side * 1.2, 0, 0}, {}}};
    return p;
  };
  const std::array setups = {setup, plate_at(-1), plate_at(1)};
  ModelAndState start = build_model(setups, glm::dvec3(0.0));
  wring(start, {20, 0});
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.004, DampingLaw::internal}), by_impulses);
  std::uint64_t touching = 0;
  for (int look = 0; look < 1000; ++look) {
    simulation.advance(10);
    touching += count_touching_pairs(start.model, simulation.state().world_positions(start.model));
  }
  const StepReport report = simulation.report();
  CAPTURE(report.contact_steps, report.reverted_vertices);
  CHECK(touching == 0);
  CHECK(report.held_parts == 0);
  CHECK_FALSE(report.breakdown);
  for (const ScriptReport& script : report.response.scripts) CHECK(script.waits == 0);
}

}  // namespace
}  // namespace pliant
