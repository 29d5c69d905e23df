// Scripted bodies: they go along their paths, push and carry soft bodies, and wait where they would cut through one.
#include "collision/responses/scripted_bodies.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "mesh/generators.hpp"
#include "simulation/overlap.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

constexpr glm::dvec3 falling{0, -9.81, 0};

BodySetup scripted(TriangleMesh mesh, std::vector<PathKeyDescription> keys) {
  BodySetup setup = body_of_mesh(std::move(mesh));
  setup.description.name = "scripted";
  setup.description.kind = BodyKind::scripted;
  setup.description.path = std::move(keys);
  return setup;
}

// A slab of 2 x 0.2 x 2 m about the origin.
TriangleMesh slab() {
  TriangleMesh mesh = generate_mesh("cube:4");
  for (glm::dvec3& p : mesh.positions) p *= glm::dvec3(2, 0.2, 2);
  return mesh;
}

BodySetup at(BodySetup setup, const glm::dvec3& position) {
  setup.description.position = position;
  return setup;
}

BodySetup stiff_cube(const glm::dvec3& position) {
  BodySetup setup = at(soft(generate_mesh("cube:2"), "cube"), position);
  setup.description.scale = 0.5;
  setup.description.total_stiffness = 2e4;
  setup.description.damping = 0.5;
  return setup;
}

glm::dvec3 mean_velocity(const Model& model, const State& state, std::size_t b) {
  const ModelBody& body = model.bodies[b];
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) sum += state.world_velocity(model, body.first_vertex + i);
  return sum / double(body.vertex_count);
}

glm::dvec3 centre(const Model& model, const State& state, std::size_t b) {
  const ModelBody& body = model.bodies[b];
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) sum += state.world_position(model, body.first_vertex + i);
  return sum / double(body.vertex_count);
}

// How far the first body's vertices are from where its path leads at the time that its clock shows [m], and the same of
// velocities [m/s].
struct Astray {
  double place = 0, velocity = 0;
};
Astray astray(Simulation& simulation, const Model& model) {
  const State state = simulation.state();
  const physics::PathPoint p = model.bodies[0].path->at(simulation.report().response.scripts.at(0).time);
  const glm::dquat q(p.quaternion[3], p.quaternion[0], p.quaternion[1], p.quaternion[2]);
  Astray most;
  for (std::uint32_t i = 0; i < model.bodies[0].vertex_count; ++i) {
    const glm::dvec3 from_centre = q * model.rest_position(i), place = glm::make_vec3(p.centre) + from_centre;
    const glm::dvec3 velocity = glm::make_vec3(p.velocity) + glm::cross(glm::make_vec3(p.spin), from_centre);
    most.place = larger(most.place, glm::length(state.world_position(model, i) - place));
    most.velocity = larger(most.velocity, glm::length(state.world_velocity(model, i) - velocity));
  }
  return most;
}

TEST_CASE("a scripted body goes along its path, with steps of every kind") {
  const std::vector<BodySetup> setups = {
      scripted(generate_mesh("icosphere:1"), {{0, {}, {}}, {0.5, {1, 2, 0}, {0, 300, 40}}, {1, {3, 0, 0}, {90, 600, 0}}}),
      at(soft(generate_mesh("icosphere:1"), "far"), {0, 20, 0})};
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(2, 64);
  for (const char* integrator : {"verlet", "cv8", "dop853"}) {
    const bool has_tolerance = std::string_view(integrator) == "dop853";
    CAPTURE(integrator);
    const TimePlan plan = has_tolerance ? plan_of(Adaptive{}, start.model) : plan_of(Method{integrator, 0.01});
    Simulation simulation(*device, start.model, start.state, plan, by_impulses);
    for (int look = 1; look <= 12; ++look) {
      has_tolerance ? void(simulation.advance_to(0.1 * look)) : simulation.advance(10);
      const StepReport report = simulation.report();
      CHECK(report.response.scripts.at(0).time == Approx(report.time));
      const Astray most = astray(simulation, start.model);
      CHECK(most.place < 1e-12);
      CHECK(most.velocity < 1e-11);
    }
    CHECK(simulation.report().response.scripts.at(0).waits == 0);
  }
}

// Nothing else gives energy.
TEST_CASE("what a body has from a scripted one is the work that this one reports") {
  BodySetup ball = at(soft(generate_mesh("icosphere:2"), "ball"), {0, 1.3, 0});
  const std::vector<BodySetup> setups = {scripted(slab(), {{0, {0, 0, 0}, {}}, {0.6, {0.2, 0.9, 0}, {10, 0, 8}}}), ball};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(2, 64);
  for (const double friction : {0.0, 0.5}) {
    CAPTURE(friction);
    CollisionDescription collision = by_impulses;
    collision.friction = friction;
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.1 / omega}), collision);
    const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 1);
    const ResponseReport& contacts = seen.report.response;
    CHECK(seen.report.reverted_vertices == 0);
    CHECK(contacts.work_of_scripts > 0.5);
    CHECK(seen.last - seen.first ==
          Approx(contacts.work_of_scripts + contacts.energy_given - contacts.energy_taken).epsilon(1e-6));
    CHECK(glm::length(seen.momentum) < 1e-11);
  }
}

TEST_CASE("a belt takes along what lies on it, and a lift carries it up") {
  const auto device = make_cpu_device(2, 32);
  std::vector<BodySetup> setups = {scripted(slab(), {}), stiff_cube({-0.6, 0.36, 0})};
  setups[0].description.velocity = {0.4, 0, 0};
  {
    const ModelAndState start = build_model(setups, falling);
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 1.0 / 240, DampingLaw::internal}),
                          by_impulses);
    simulation.advance(480);
    const State state = simulation.state();
    CHECK(glm::length(mean_velocity(start.model, state, 1) - glm::dvec3(0.4, -9.81 / 480, 0)) < 0.02);  // it sways on
    CHECK(count_touching_pairs(start.model, state.world_positions(start.model)) == 0);
  }
  setups[0] = scripted(slab(), {{0, {}, {}}, {1, {0, 1, 0}, {}}});
  const ModelAndState start = build_model(setups, falling);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 1.0 / 240, DampingLaw::internal}), by_impulses);
  simulation.advance(720);
  const State state = simulation.state();
  CHECK(centre(start.model, state, 1).y == Approx(1.35).margin(0.02));
  CHECK(glm::length(mean_velocity(start.model, state, 1)) < 0.05);
  const ResponseReport contacts = simulation.report().response;
  CHECK(contacts.scripts.at(0).waits == 0);
  CHECK(contacts.work_of_scripts == Approx(9.81).epsilon(0.05));  // of 1 kg by 1 m, and some that damping took
}

// The plate goes below the ground. What it presses can't give way.
TEST_CASE("a scripted body waits rather than cut through what it presses") {
  const std::vector<BodySetup> setups = {
      scripted(slab(), {{0, {0, 2.2, 0}, {}}, {0.5, {0, -0.2, 0}, {}}, {0.6, {0, -0.2, 0}, {}}, {1.2, {0, 3, 0}, {}}}),
      at(soft(generate_mesh("icosphere:1"), "ball"), {0, 1.05, 0})};
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, falling, {&ground, 1});
  const auto device = make_cpu_device(2, 32);
  for (const bool has_tolerance : {false, true}) {
    CAPTURE(has_tolerance);
    const TimePlan plan = has_tolerance ? plan_of(Adaptive{}, start.model) : plan_of(Method{"cv8", 1.0 / 120});
    Simulation simulation(*device, start.model, start.state, plan, by_impulses);
    for (int look = 1; look <= 16; ++look) {
      has_tolerance ? void(simulation.advance_to(0.05 * look)) : simulation.advance(6);
      const std::vector<glm::dvec3> positions = simulation.state().world_positions(start.model);
      CHECK(count_touching_pairs(start.model, positions) == 0);
      for (std::uint32_t i = start.model.bodies[1].first_vertex; i < positions.size(); ++i) CHECK(positions[i].y > 0);
      CHECK(astray(simulation, start.model).place < 1e-12);
      const StepReport report = simulation.report();
      const ScriptReport& script = report.response.scripts.at(0);
      CHECK(script.time + script.waited == Approx(report.time));
    }
    const ScriptReport script = simulation.report().response.scripts.at(0);
    CHECK((script.waits > 10 && script.waited > 0.1));
  }
}

// The paddle's tip is twice as fast as sound in the ball.
TEST_CASE("no body is cut by a fast paddle") {
  BodySetup paddle = scripted(slab(), {});
  paddle.description.spin = {0, 0, 25};
  const std::vector<BodySetup> setups = {paddle, at(soft(generate_mesh("icosphere:1"), "ball"), {0.9, 1.8, 0}),
                                         at(soft(generate_mesh("icosphere:1"), "other"), {-1.2, -2, 0})};
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 1.0 / 120}), by_impulses);
  for (int look = 0; look < 60; ++look) {
    simulation.advance(2);
    CHECK(count_touching_pairs(start.model, simulation.state().world_positions(start.model)) == 0);
  }
  const StepReport report = simulation.report();
  CHECK(!report.breakdown);
  CHECK(report.contact_steps > 5);
  CHECK(report.response.work_of_scripts > 10);
}

// In the box's own frame nothing may be outside, which pairs of triangles would not tell.
TEST_CASE("what a shaken box holds stays in it") {
  BodySetup box =
      scripted(generate_mesh("box:2.4,2.2,2.4,8"),
               {{0, {0, 0, 0}, {}}, {0.4, {0.5, 0.2, 0}, {0, 20, 30}}, {0.8, {-0.5, 0, 0.3}, {0, 0, -30}}, {1.2, {0, 0, 0}, {}}});
  box.description.is_container = true;
  box.description.repeats = true;
  std::vector<BodySetup> setups = {box};
  for (int k = 0; k < 8; ++k) {
    setups.push_back(
        at(soft(generate_mesh("icosphere:1"), "ball"), {0.8 * (k % 2) - 0.4, 0.8 * (k / 2 % 2) - 0.5, 0.8 * (k / 4) - 0.4}));
    setups.back().description.scale = 0.35;
  }
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1.0 / 120}), by_impulses);
  for (int look = 0; look < 75; ++look) {
    simulation.advance(4);
    const State state = simulation.state();
    CHECK(count_touching_pairs(start.model, state.world_positions(start.model)) == 0);
    const physics::PathPoint box_at = start.model.bodies[0].path->at(simulation.report().response.scripts.at(0).time);
    const glm::dquat q(box_at.quaternion[3], box_at.quaternion[0], box_at.quaternion[1], box_at.quaternion[2]);
    for (std::uint32_t i = start.model.bodies[1].first_vertex; i < start.model.vertex_count(); ++i) {
      const glm::dvec3 p = glm::abs(glm::conjugate(q) * (state.world_position(start.model, i) - glm::make_vec3(box_at.centre)));
      CHECK((p.x < 1.2 && p.y < 1.1 && p.z < 1.2));
    }
  }
  CHECK(!simulation.report().breakdown);
}

TEST_CASE("scenes with scripted bodies end in the same bits on any number of threads, and when they are resumed") {
  const std::vector<BodySetup> setups = {
      scripted(slab(), {{0, {0, 2.4, 0}, {}}, {0.25, {0, -0.2, 0}, {}}, {0.3, {0, -0.2, 0}, {}}, {0.6, {0, 3, 0}, {0, 90, 0}}}),
      at(soft(generate_mesh("icosphere:1"), "ball"), {0, 1.05, 0}), stiff_cube({2.2, 0.3, 0})};
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, falling, {&ground, 1});
  const SavedRun run = check_same_bits(start, {"cv8", 1.0 / 120}, by_impulses, 40, 80);
  CHECK(run.saved.response.scripts.at(0).waits > 0);  // so that the clock is not the run's
}

TEST_CASE("a scripted body that holds still counts as at rest, and lets others sleep until it moves") {
  const std::vector<BodySetup> setups = {scripted(slab(), {{0, {}, {}}, {3, {}, {}}, {3.5, {0.5, 0, 0}, {}}}),
                                         stiff_cube({0, 0.36, 0})};
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(2, 32);
  TimePlan plan = plan_of(Method{"cv8", 1.0 / 120, DampingLaw::internal});
  plan.sleep = true;
  Simulation simulation(*device, start.model, start.state, plan, by_impulses);
  simulation.advance(340);
  CHECK(simulation.report().bodies_asleep == 1);
  CHECK(simulation.report().steps_at_rest > 200);
  simulation.advance(30);
  CHECK(simulation.report().bodies_asleep == 0);
  simulation.advance(60);
  CHECK(simulation.report().response.scripts.at(0).waits == 0);
  CHECK(centre(start.model, simulation.state(), 1).x == Approx(0.5).margin(0.02));
}

// Empty steps come behind the last one before a frame, and keys stand at frames.
TEST_CASE("with a tolerance a scripted body goes along its path from a hold on, too") {
  const std::vector<BodySetup> setups = {
      scripted(generate_mesh("icosphere:1"),
               {{0.25, {}, {}}, {0.5, {1, 0, 0}, {}}, {1, {1, 0, 0}, {}}, {1.25, {0, 0, 0}, {0, 90, 0}}}),
      at(soft(generate_mesh("icosphere:1"), "far"), {0, 20, 0})};
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Adaptive{}, start.model), by_impulses);
  double before = 0;
  for (int look = 1; look <= 60; ++look) {
    simulation.advance_to(0.025 * look);
    CHECK(astray(simulation, start.model).place < 1e-12);
    const double x = centre(start.model, simulation.state(), 0).x;
    CHECK(std::abs(x - before) < 1.5 * 4 * 0.025 + 1e-9);  // the path is no faster
    before = x;
  }
  CHECK(simulation.report().response.scripts.at(0).waited < 1e-12);
}

TEST_CASE("a scripted body that is alone goes along its path, by every device alike", "[gl]") {
  const std::vector<BodySetup> setups = {scripted(slab(), {{0, {0.1, 0, 0}, {}}, {1, {1.1, 0, 0}, {0, 90, 20}}})};
  const ModelAndState start = build_model(setups, falling);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_of(Method{"cv8", 0.01}), by_impulses);
    for (int look = 1; look <= 10; ++look) {
      simulation.advance(10);
      const Astray most = astray(simulation, start.model);
      CHECK(most.place < 1e-12);
      CHECK(most.velocity < 1e-11);
    }
    CHECK(centre(start.model, simulation.state(), 0).x == Approx(1.1));
  }
}

// A ball on a lift would else lose its vibration in each step, since it parts from the lift's place as fast as the lift goes.
TEST_CASE("restitution leaves impacts with scripted bodies alone") {
  const std::vector<BodySetup> setups = {scripted(slab(), {{0, {}, {}}, {1, {0, 1, 0}, {}}}),
                                         at(soft(generate_mesh("icosphere:1"), "ball"), {0, 1.15, 0})};
  const ModelAndState start = build_model(setups, falling);
  const auto device = make_cpu_device(1, 32);
  std::vector<double> motions[2];
  for (const bool restores : {false, true}) {
    CollisionDescription collision = by_impulses;
    if (restores) collision.restitution = 0.3;
    Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1.0 / 120}), collision);
    simulation.advance(120);
    motions[restores ? 1 : 0] = simulation.state().motion;
  }
  CHECK(motions[0] == motions[1]);
}

TEST_CASE("what lies on a slow belt does not sleep, and what lies under a press that has not begun does") {
  const auto device = make_cpu_device(2, 32);
  TimePlan plan = plan_of(Method{"cv8", 1.0 / 120, DampingLaw::internal});
  plan.sleep = true;
  {
    std::vector<BodySetup> setups = {scripted(slab(), {}), stiff_cube({-0.5, 0.355, 0})};
    setups[0].description.velocity = {0.02, 0, 0};
    const ModelAndState start = build_model(setups, falling);
    Simulation simulation(*device, start.model, start.state, plan, by_impulses);
    simulation.advance(600);
    CHECK(simulation.report().energy_slept == 0);
    CHECK(centre(start.model, simulation.state(), 1).x == Approx(-0.4).margin(0.01));
  }
  const GroundDescription ground;
  const std::vector<BodySetup> setups = {scripted(slab(), {{10, {0, 2, 0}, {}}, {11, {0, 0.6, 0}, {}}}),
                                         stiff_cube({0, 0.26, 0})};
  const ModelAndState start = build_model(setups, falling, {&ground, 1});
  Simulation simulation(*device, start.model, start.state, plan, by_impulses);
  simulation.advance(400);
  CHECK(simulation.report().bodies_asleep == 1);
}

TEST_CASE("a body that a path reaches in one long step is not passed") {
  const std::vector<BodySetup> setups = {scripted(slab(), {{0, {0, 0, 0}, {}}, {0.5, {0, 0, 0}, {}}, {0.502, {0, 3, 0}, {}}}),
                                         at(soft(generate_mesh("icosphere:1"), "ball"), {0, 1.5, 0})};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"verlet", 1.0 / 60}), by_impulses);
  for (int look = 0; look < 40; ++look) {
    simulation.advance(2);
    const State state = simulation.state();
    CHECK(count_touching_pairs(start.model, state.world_positions(start.model)) == 0);
    CHECK(centre(start.model, state, 1).y > centre(start.model, state, 0).y);
  }
  CHECK(simulation.report().substeps > 0);
}

}  // namespace
}  // namespace pliant
