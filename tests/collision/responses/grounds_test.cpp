// Contact by impulses with grounds and static bodies: what lies on them rests, slides as Coulomb's law says, and gets the
// momentum that they report.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/contact/meeting.hpp"
#include "model/mean_edge.hpp"
#include "simulation/start_check.hpp"
#include "support/expect_error.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

// A body of the mesh that was let down on the ground, with gravity at this angle to its normal.
ModelAndState on_ground(const char* mesh, double height, double degrees, double friction, double stiffness = total_stiffness) {
  BodySetup setup = soft(generate_mesh(mesh), "body");
  setup.description.position = {0, height, 0};
  setup.description.damping = 0.02;
  const double angle = degrees / 180 * 3.14159265358979;
  GroundDescription ground;
  ground.surface.friction = friction;
  setup.description.surface.friction = friction;
  setup.description.total_stiffness = stiffness;
  return build_model({&setup, 1}, {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0}, {&ground, 1});
}

TEST_CASE("a ball comes to rest on a ground, which then bears its weight") {
  const ModelAndState start = on_ground("icosphere:1", 1.1, 0, 0.5);
  const double time_step = 0.3 / omega, seconds = 1;
  const auto device = make_cpu_device(1, 64);
  Simulation resting(*device, start.model, start.state, plan_of(Method{"cv8", time_step, DampingLaw::constant}), by_impulses);
  resting.advance(4000);
  const auto before = resting.state().world_positions(start.model);
  const double given = resting.report().response.outside_impulse.y;
  const auto steps = static_cast<std::uint64_t>(seconds / time_step);
  resting.advance(steps);
  const auto after = resting.state().world_positions(start.model);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(glm::length(after[i] - before[i]) < 1e-9 * static_cast<double>(steps));
  CHECK(resting.report().response.outside_impulse.y - given ==
        Approx(9.81 * time_step * static_cast<double>(steps)).epsilon(1e-6));
  for (const glm::dvec3& p : after) CHECK(p.y > 0);
  CHECK(resting.report().reverted_vertices == 0);
}

TEST_CASE("a body at rest keeps the gap, which is the geometric mean of the two") {
  const auto device = make_cpu_device(1, 64);
  for (const auto& [gap, omega_step] : {std::pair(0.02, 0.3), std::pair(0.08, 0.3), std::pair(0.02, 0.02)}) {
    CAPTURE(gap, omega_step);
    ModelAndState start = on_ground("icosphere:1", 1.1, 0, 0.5);
    start.model.bodies[0].surface.gap = gap;
    start.model.grounds[0].surface.gap = gap / 4;
    Simulation resting(*device, start.model, start.state, plan_of(Method{"verlet", omega_step / omega, DampingLaw::constant}),
                       by_impulses);
    resting.advance(static_cast<std::uint64_t>(1200 / omega_step));
    double lowest = 1;
    for (const glm::dvec3& p : resting.state().world_positions(start.model)) lowest = std::min(lowest, p.y);
    const double edge = mean_edge(start.model, start.model.bodies[0]);
    CHECK(lowest == Approx(gap / 2 * edge).margin(0.002 * edge));  // a step's end is a little above its mean
  }
}

// Near the ground it falls in a step by more than what is left, so the first contact stops it far above.
TEST_CASE("a body that stops above the ground in a long step sinks to it") {
  const auto device = make_cpu_device(1, 32);
  for (const double step : {0.003, 0.01, 0.0167}) {
    CAPTURE(step);
    BodySetup setup = soft(generate_mesh("icosphere:1"), "grain");
    setup.description.scale = 1e-3;
    setup.description.position = {0, 0.05, 0};
    setup.description.surface.gap = 0.05;
    GroundDescription ground;
    ground.surface.gap = 0.05;
    const ModelAndState start = build_model({&setup, 1}, {0, -9.81, 0}, {&ground, 1});
    Simulation falling(*device, start.model, start.state, plan_of(Method{"verlet", step, DampingLaw::internal}), by_impulses);
    falling.advance(static_cast<std::uint64_t>(1 / step));
    double lowest = 1;
    for (const glm::dvec3& p : falling.state().world_positions(start.model)) lowest = std::min(lowest, p.y);
    const double gap = 0.05 * mean_edge(start.model, start.model.bodies[0]);
    CHECK(lowest > 0);
    CHECK(lowest < 1.5 * gap);
    CHECK(falling.report().reverted_vertices == 0);
  }
}

TEST_CASE("momentum is what gravity and the ground have given") {
  const ModelAndState start = on_ground("icosphere:1", 1.3, 20, 0.3);
  const auto device = make_cpu_device(1, 64);
  const double angle = 20 / 180.0 * 3.14159265358979, duration = 200 * 0.3 / omega;
  for (const bool has_tolerance : {false, true}) {
    CAPTURE(has_tolerance);
    const TimePlan plan = has_tolerance ? plan_of(Adaptive{}, start.model) : plan_of(Method{"verlet", 0.3 / omega});
    Simulation simulation(*device, start.model, start.state, plan, by_impulses);
    has_tolerance ? void(simulation.advance_to(duration)) : simulation.advance(200);
    ThreadPool pool(1);
    const glm::dvec3 momentum = measure(start.model, simulation.state(), glm::dvec3(0.0), pool).momentum;
    const StepReport report = simulation.report();
    const glm::dvec3 expected =
        report.time * 9.81 * glm::dvec3(std::sin(angle), -std::cos(angle), 0) + report.response.outside_impulse;
    CHECK(report.time == Approx(duration));
    if (has_tolerance) CHECK(report.adaptive->rejected > 0);
    CHECK(report.response.outside_impulse.y > 1);
    CHECK(glm::length(momentum - expected) < 1e-11);
  }
}

// How far a cube goes down a slope of 20 degrees in this time, in the time after it, and in a third such time [m].
std::array<double, 3> ways_on_slope(double friction, DampingLaw law, std::uint64_t steps) {
  const auto device = make_cpu_device(1, 64);
  const ModelAndState start = on_ground("cube:3", 0.51, 20, friction, 1e4);  // stiff, so that it does not topple
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.003, law}), by_impulses);
  std::array<double, 3> ways{};
  double before = 0;
  for (double& way : ways) {
    simulation.advance(steps);
    double mean = 0;
    for (const glm::dvec3& p : simulation.state().world_positions(start.model)) mean += p.x / start.model.vertex_count();
    way = mean - before;
    before = mean;
  }
  return ways;
}

TEST_CASE("a cube stays on a slope with enough friction, and slides with less as Coulomb's law says") {
  const std::array<double, 3> still = ways_on_slope(0.5, DampingLaw::constant, 3000);
  CHECK(std::abs(still[2]) < 1e-6 * 9);  // in 9 s
  const std::array<double, 3> sliding = ways_on_slope(0.2, DampingLaw::none, 300);
  const double angle = 20 / 180.0 * 3.14159265358979, seconds = 0.9;
  const double acceleration = (sliding[2] - sliding[1]) / (seconds * seconds);
  CHECK(acceleration == Approx(9.81 * (std::sin(angle) - 0.2 * std::cos(angle))).epsilon(0.02));
}

TEST_CASE("a flat mesh of many triangles does not brake what slides on it without friction") {
  std::vector<BodySetup> setups = {soft(generate_mesh("cube:10"), "plate"), soft(generate_mesh("cube:3"), "cube")};
  setups[0].description.kind = BodyKind::immovable;
  setups[0].description.scale = 4;
  setups[1].description.position = {-1, 2.52, 0.1};
  setups[1].description.velocity = {2, 0, 0.3};
  setups[1].description.total_stiffness = 2e4;
  const ModelAndState start = build_model(setups, {0, -9.81, 0});
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.002}),
                        {.response = {"impulse"}, .elasticity = 0, .friction = 0});
  simulation.advance(250);
  ThreadPool pool(1);
  const glm::dvec3 momentum = measure(start.model, simulation.state(), glm::dvec3(0.0), pool).momentum;
  CHECK(simulation.report().contact_steps > 200);
  CHECK(momentum.x == Approx(2).epsilon(1e-4));
  CHECK(momentum.z == Approx(0.3).epsilon(1e-3));
}

TEST_CASE("a static body stays where it is, has no energy and bears others") {
  std::vector<BodySetup> setups = {soft(generate_mesh("cube:2"), "plate"), soft(generate_mesh("icosphere:1"), "ball")};
  setups[0].description.kind = BodyKind::immovable;
  setups[0].description.scale = 4;
  setups[0].description.position = {0, 3, 0};
  setups[1].description.position = {0.1, 6.1, 0};
  setups[1].description.damping = 0.02;
  const ModelAndState start = build_model(setups, {0, -9.81, 0});
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.3 / omega, DampingLaw::constant}),
                        by_impulses);
  const auto before = start.state.world_positions(start.model);
  simulation.advance(1500);
  const auto after = simulation.state().world_positions(start.model);
  const ModelBody &plate = start.model.bodies[0], &ball = start.model.bodies[1];
  for (std::uint32_t i = 0; i < plate.vertex_count; ++i) CHECK(after[i] == before[i]);
  for (std::uint32_t i = ball.first_vertex; i < start.model.vertex_count(); ++i) CHECK(after[i].y > 5);
  CHECK(bench::ApartOracle(start.model).pairs_not_apart(after) == 0);
  ThreadPool pool(1);
  const Measurement now = measure(start.model, simulation.state(), {0, -9.81, 0}, pool);
  CHECK((now.gravitational > 9.81 * 5 && now.gravitational < 9.81 * 7));  // the ball's alone: a plate of 1 kg would add 29 J
  CHECK(simulation.report().response.outside_impulse.y > 0);
  CHECK(simulation.report().force_evaluations <= 1500u * 30);
}

TEST_CASE("bodies that begin in each other or in the ground are an error that names them") {
  const auto device = make_cpu_device(1, 32);
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "left"), soft(generate_mesh("icosphere:1"), "right")};
  setups[1].description.position = {0.5, 0.3, 0.1};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  Simulation overlapping(*device, start.model, start.state, plan_of(Method{"verlet", 0.01}), by_impulses);
  const Error error = error_of([&] { expect_apart(overlapping, start.model, by_impulses, "scene.toml"); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"scene.toml", "bodies \"left\" and \"right\" intersect", "m deep", "move them apart, such as \"right\" by [",
                     "response = \"reflect\""});
  const ModelAndState sunk = on_ground("icosphere:1", 0.75, 0, 0.5);
  Simulation buried(*device, sunk.model, sunk.state, plan_of(Method{"verlet", 0.01}), by_impulses);
  check_says(error_of([&] { expect_apart(buried, sunk.model, by_impulses, "scene.toml"); }),
             {"scene.toml: body \"body\"", "deep in this ground", "move the body by [0, ", "or move the ground"});
  Simulation reflecting(*device, start.model, start.state, plan_of(Method{"verlet", 0.01}), {.response = {"reflect"}});
  CHECK_NOTHROW(expect_apart(reflecting, start.model, {.response = {"reflect"}}, "scene.toml"));
}

// A ball lies on the ground while another one flies beyond what places in fp32 can tell.
TEST_CASE("after a breakdown no queued step pushes what lies on a ground") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "lying"), soft(generate_mesh("icosphere:1"), "leaving")};
  setups[0].description.position = {0, 1.01, 0};
  setups[1].description.position = {50, 1e4, 0};
  const GroundDescription ground;
  ModelAndState start = build_model(setups, {0, -9.81, 0}, {&ground, 1});
  for (std::uint32_t i = start.model.bodies[1].first_vertex; i < start.model.vertex_count(); ++i)
    start.state.motion[physics::velocity_of(i) + 1] = 3e38;
  const auto device = make_cpu_device(1, 64);
  std::vector<std::vector<double>> motions;
  std::vector<StepReport> reports;
  for (const std::uint64_t at_once : {1, 1000}) {
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 0.01}), by_impulses);
    for (std::uint64_t step = 0; step < 1000; step += at_once) simulation.advance(at_once);
    motions.push_back(simulation.state().motion);
    reports.push_back(simulation.report());
  }
  REQUIRE(reports[0].breakdown.has_value());
  CHECK(reports[0].contact_steps > 3);
  CHECK(reports[1].contact_steps == reports[0].contact_steps);
  CHECK(reports[1].response.energy_taken == reports[0].response.energy_taken);
  motions[0].resize(physics::motion_size * start.model.bodies[0].vertex_count);
  motions[1].resize(motions[0].size());
  CHECK(motions[1] == motions[0]);
}

// What contacts gave a body in the latest part of a step [Ns].
glm::dvec3 given_to(const Model& model, std::uint32_t body, std::span<const ContactImpulse> contacts) {
  glm::dvec3 sum(0.0);
  for (const ContactImpulse& contact : contacts)
    for (int k = 0; k < 4; ++k)
      if (contact.vertex[k] != physics::no_vertex && model.body_index(contact.vertex[k]) == body)
        sum += contact.weight[k] * contact.impulse;
  return sum;
}

// Of a body [kg m/s].
glm::dvec3 momentum_of(const Model& model, const State& state, std::uint32_t body) {
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = 0; i < velocities.size(); ++i)
    if (model.body_index(i) == body) sum += model.body_of(i).vertex_mass * velocities[i];
  return sum;
}

TEST_CASE("the impulses of contacts are what bodies got from each other and from grounds") {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:1"), "left"), soft(generate_mesh("icosphere:1"), "right")};
  setups[0].description.position = {-1.01, 1.01, 0};
  setups[0].description.velocity = {1, 0, 0};
  setups[1].description.position = {1.01, 1.03, 0.05};
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, gravity, {&ground, 1});
  ThreadPool pool(1);
  for (const int precision : {32, 64}) {
    const auto device = make_cpu_device(1, precision);
    for (const bool has_tolerance : {false, true}) {
      CAPTURE(precision, has_tolerance);
      const TimePlan plan = has_tolerance ? plan_of(Adaptive{.tolerance = 1e-5}, start.model) : plan_of(Method{"verlet", 0.005});
      Simulation simulation(*device, start.model, start.state, plan, by_impulses);
      CHECK(simulation.contact_impulses().empty());
      glm::dvec3 before(0.0), right_before(0.0);
      double time = 0;
      for (int part = 0; part < 60; ++part) {
        has_tolerance ? void(simulation.advance_toward(10, 1)) : simulation.advance_part();
        const glm::dvec3 outside = simulation.report().response.outside_impulse;
        const std::vector<ContactImpulse> contacts = simulation.contact_impulses();
        const glm::dvec3 sum = given_to(start.model, 0, contacts) + given_to(start.model, 1, contacts);
        CHECK(glm::length(sum - (outside - before)) < 1e-6);
        before = outside;
        const glm::dvec3 right = momentum_of(start.model, simulation.state(), 1);
        const glm::dvec3 by_gravity = (simulation.report().time - time) * gravity;  // a body has 1 kg
        CHECK(glm::length(right - right_before - by_gravity - given_to(start.model, 1, contacts)) < 1e-5);
        right_before = right;
        time = simulation.report().time;
      }
      CHECK(before.y > 0.1);
      CHECK_FALSE(simulation.contact_impulses().empty());
      simulation.restore(simulation.save());
      CHECK(simulation.contact_impulses().empty());
    }
  }
}

}  // namespace
}  // namespace pliant
