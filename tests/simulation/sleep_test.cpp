// Bodies that rest on something sleep until something may reach them.
#include <catch2/catch.hpp>
#include <glm/trigonometric.hpp>

#include "bench/contact/apart.hpp"
#include "core/larger.hpp"
#include "support/device_bench.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"
#include "support/pocket.hpp"

namespace pliant {
namespace {

const glm::dvec3 downward(0, -9.81, 0);

BodySetup lying_ball(const glm::dvec3& place) {
  BodySetup setup = soft(generate_mesh("icosphere:1"), "ball");
  setup.description.scale = 0.4;
  setup.description.position = place;
  setup.description.total_stiffness = 4000;
  setup.description.damping = 2;
  return setup;
}

ModelAndState on_floor(const std::vector<BodySetup>& balls) {
  const GroundDescription floor;
  return build_model(balls, downward, {&floor, 1});
}

TimePlan sleeping(std::string_view integrator = "verlet") {
  TimePlan plan = plan_of({integrator, 0.002, DampingLaw::internal});
  plan.sleep = true;
  return plan;
}

void advance_to(Simulation& simulation, double time) {
  while (simulation.report().time < time) simulation.advance(20);
}

TEST_CASE("balls that lie on a floor fall asleep, keep every bit from then on, and tell what that took", "[gl]") {
  const ModelAndState start = on_floor({lying_ball({0, 0.5, 0}), lying_ball({2, 0.7, 0})});
  for (const TestDevice& test : all_devices())
    for (const char* integrator : {"verlet", "cv8"}) {
      CAPTURE(test.name, integrator);
      if (test.name == "gpu" && std::string_view(integrator) == "cv8") continue;  // slow in software
      Simulation simulation(*test.device, start.model, start.state, sleeping(integrator), by_impulses);
      advance_to(simulation, 2);
      const StepReport report = simulation.report();
      REQUIRE(report.bodies_asleep == 2);
      CHECK(report.steps_asleep > 100);
      CHECK(report.energy_slept > 0);
      CHECK(report.energy_slept < 0.05);  // of 12 J. A part of it is what a kick takes in each step from what gravity gives in it
      const std::vector<double> motion = simulation.state().motion;
      simulation.advance(50);
      CHECK(simulation.state().motion == motion);
      CHECK(simulation.report().steps_asleep == report.steps_asleep + 100);
      CHECK(simulation.intersections().pairs == 0);
    }
}

TEST_CASE("a ball that falls on one that sleeps wakes it and its island, and they sleep again") {
  std::vector<BodySetup> balls{lying_ball({0, 0.45, 0}), lying_ball({0.83, 0.45, 0}), lying_ball({3, 0.45, 0})};
  balls.push_back(lying_ball({0.1, 16, 0}));  // falls for 1.75 s
  std::vector<GroundDescription> trough(5);
  for (std::size_t k = 1; k < 5; ++k) {
    trough[k].normal = glm::dvec3(k == 1, 0, k == 3) - glm::dvec3(k == 2, 0, k == 4);
    trough[k].point = glm::dvec3(k == 2 ? 3.45 : -0.45, 0, k == 4 ? 0.45 : -0.45);
  }
  const ModelAndState start = build_model(balls, downward, trough);
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, sleeping(), by_impulses);
  advance_to(simulation, 1.7);
  REQUIRE(simulation.report().bodies_asleep == 3);
  const std::vector<double> asleep = simulation.state().motion;
  advance_to(simulation, 1.9);
  CHECK(simulation.report().bodies_asleep == 1);  // the one that lies apart
  const std::vector<double> hit = simulation.state().motion;
  const auto moved = [&](std::size_t b) {
    const ModelBody& body = start.model.bodies[b];
    return !std::equal(hit.begin() + 6 * body.first_vertex, hit.begin() + 6 * (body.first_vertex + body.vertex_count),
                       asleep.begin() + 6 * body.first_vertex);
  };
  CHECK(moved(0));
  CHECK(moved(1));
  CHECK(!moved(2));
  advance_to(simulation, 12);
  CHECK(simulation.report().bodies_asleep == 4);
  CHECK(simulation.intersections().pairs == 0);
}

TEST_CASE("what floats slowly does not sleep, and what is pulled wakes") {
  const auto device = make_cpu_device(1, 32);
  BodySetup floating = lying_ball({0, 3, 0});
  floating.description.velocity = {1e-4, 0, 0};
  const ModelAndState drift = build_model({&floating, 1}, glm::dvec3(0.0));
  Simulation drifts(*device, drift.model, drift.state, sleeping(), by_impulses);
  drifts.advance(1000);
  CHECK(drifts.report().bodies_asleep == 0);

  const ModelAndState start = on_floor({lying_ball({0, 0.45, 0})});
  Simulation lies(*device, start.model, start.state, sleeping(), by_impulses);
  advance_to(lies, 3);
  REQUIRE(lies.report().bodies_asleep == 1);
  const double before = lies.world_positions()[3].y;
  for (int step = 0; step < 100; ++step) {
    lies.pull({.vertex = 3, .target = {0, 2, 0}}, 0.002);
    lies.advance(1);
  }
  CHECK(lies.report().bodies_asleep == 0);
  CHECK(lies.world_positions()[3].y > before + 0.05);
}

// Steps until a body sleeps.
std::uint64_t steps_to_sleep(const ModelAndState& start, const TimePlan& plan) {
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan, by_impulses);
  std::uint64_t steps = 0;
  for (; simulation.report().bodies_asleep == 0 && steps < 2000; ++steps) simulation.advance(1);
  return steps;
}

BodySetup of_mass(BodySetup ball, double mass) {
  ball.description.total_mass = mass;
  *ball.description.total_stiffness *= mass;  // it vibrates as fast
  ball.description.damping *= mass;
  return ball;
}

// Calls check(simulation, time step) on each device, by two methods, once so many bodies sleep.
template <class Check>
void for_each_asleep(const ModelAndState& start, std::uint32_t bodies, const Check& check) {
  for (const TestDevice& test : all_devices())
    for (const char* integrator : {"verlet", "cv8"}) {
      CAPTURE(test.name, integrator);
      const bool is_software = test.name == "gpu" && test.device->shares_at_once() == 0;
      if (is_software && std::string_view(integrator) == "cv8") continue;  // slow
      const TimePlan plan = sleeping(integrator);
      Simulation simulation(*test.device, start.model, start.state, plan, by_impulses);
      while (simulation.report().bodies_asleep < bodies && simulation.report().time < 6) simulation.advance(20);
      REQUIRE(simulation.report().bodies_asleep == bodies);
      check(simulation, plan.time_step);
    }
}

// A hand that takes hold where a vertex is wakes the body, and changes no velocity. Bodies that sleep have no velocity, so half
// of what gravity gives in a step stops them in its mean. Forces on vertices that press are many times that.
TEST_CASE("what wakes is held from its first step on by what it lies on", "[gl]") {
  const ModelAndState start = on_floor({lying_ball({0, 0.45, 0})});
  for_each_asleep(start, 1, [&](Simulation& simulation, double time_step) {
    simulation.advance(5);
    const glm::vec3 place(simulation.world_positions()[0]);
    const double before = simulation.report().response.outside_impulse.y;
    simulation.pull({.vertex = 0, .target = glm::dvec3(place)}, time_step);
    simulation.advance(1);
    CHECK(simulation.report().bodies_asleep == 0);
    const double weight = start.model.bodies[0].vertex_count * start.model.bodies[0].vertex_mass * 9.81;  // [N]
    const double given = (simulation.report().response.outside_impulse.y - before) / (weight * time_step);
    CHECK(given > 0.4);
    CHECK(given < 0.6);
  });
}

// A ball between the floor and a static slab, which squeeze it by an eighth. Another body comes with it.
ModelAndState squeezed_beside(const BodySetup& other) {
  BodySetup squeezed = lying_ball({0, 0.36, 0}), slab = soft(generate_mesh("cube:2"), "slab");
  squeezed.description.stretch = {1, 0.85, 1};
  slab.description.kind = BodyKind::immovable;
  slab.description.scale = 0.6;
  slab.description.position = {0, 1.02, 0};
  return on_floor({squeezed, other, slab});
}

// The farthest that a vertex of the first body is from where it was [m].
double farthest_from(const std::vector<glm::vec4>& places, const std::vector<glm::vec4>& now, const Model& model) {
  double farthest = 0;
  for (std::uint32_t i = 0; i < model.bodies[0].vertex_count; ++i)
    farthest = larger(farthest, glm::distance(glm::dvec3(places[i]), glm::dvec3(now[i])));
  return farthest;
}

// How far springs would move a vertex of the first body in a step if nothing held it, at most [m]. Bodies that rest have no mean
// velocity, so vertices that are held end a step with half of what their springs give in one. From rest that is the mean.
double farthest_unheld(const State& resting, const Model& model, double time_step) {
  double fastest = 0;
  const std::vector<glm::dvec3> velocities = resting.world_velocities(model);
  for (std::uint32_t i = 0; i < model.bodies[0].vertex_count; ++i) fastest = larger(fastest, glm::length(velocities[i]));
  return fastest * time_step;
}

// A hand drags the neighbour away at 0.1 m/s.
TEST_CASE("a ball that is squeezed as it sleeps does not jump when a neighbour that moves wakes it", "[gl]") {
  const ModelAndState start = squeezed_beside(lying_ball({0.86, 0.41, 0}));
  for_each_asleep(start, 2, [&](Simulation& simulation, double time_step) {
    const std::vector<glm::vec4> places = simulation.world_positions();
    const std::uint32_t held = start.model.bodies[1].first_vertex;
    double farthest = 0;
    for (int step = 1; step <= 50; ++step) {
      const glm::dvec3 way(0.1 * step * time_step, 0, 0);
      simulation.pull({.vertex = held, .target = glm::dvec3(places[held]) + way}, time_step);
      simulation.advance(1);
      if (step == 1) CHECK(simulation.report().bodies_asleep == 0);
      farthest = larger(farthest, farthest_from(places, simulation.world_positions(), start.model));
    }
    const double unheld = farthest_unheld(simulation.state(), start.model, time_step);
    CHECK(unheld > 5 * 9.81 * time_step * time_step);
    CHECK(farthest < 0.3 * unheld);
    CHECK(glm::distance(places[held], simulation.world_positions()[held]) > 100 * farthest);
    CHECK(simulation.intersections().pairs == 0);
  });
}

// A run in which motions of the squeezed ball are cut short, by hand, in one step. That is the first step of its sleep, or the
// one in which a ball that falls by comes within an edge of 0.24 m, and wakes it.
struct CutInSleep {
  CutInSleep(std::unique_ptr<Device> device, bool as_it_wakes)
      : start(squeezed_beside(lying_ball({0.9, 8, 0}))),
        bench(std::move(device), start, {"verlet", time_step, DampingLaw::internal}, by_impulses),
        cuts_as_it_wakes(as_it_wakes) {
    bench.begin();
  }
  [[nodiscard]] physics::Status status() const { return bench.bodies.statuses.download().front(); }
  [[nodiscard]] State state() const { return bench.bodies.download(half); }
  [[nodiscard]] std::vector<glm::vec4> places() const {
    return bench.bodies.world_positions.download(bench.bodies.first_of_half(half), start.model.vertex_count());
  }
  // Returns whether motions were cut short.
  bool make_step(bool may_cut) {
    bool is_cut = false;
    for (const Pass& pass : bench.step(half)) {
      bench.device->run({&pass, 1});
      if (pass.name != "expect_cuts" || !may_cut) continue;
      is_cut = status().asleep != 0 && (status().disturbed != 0) == cuts_as_it_wakes;
      if (is_cut) cut_by_hand(bench.bodies.arrays.get<std::uint32_t>("cut"), cuts);
    }
    half = 1 - half;
    return is_cut;
  }
  static constexpr double time_step = 0.002;
  static constexpr std::size_t cuts = 8;
  ModelAndState start;
  Bench bench;
  bool cuts_as_it_wakes;
  std::uint32_t half = 0;
};

// A cut rouses the body while the step goes on for its other vertices.
TEST_CASE("a ball whose motions are cut short as it sleeps, or as it wakes, is awake from then on and does not jump", "[gl]") {
  for (const bool on_gpu : {false, true})
    for (const bool as_it_wakes : {false, true}) {
      if (on_gpu && !test::has_gl()) continue;
      CAPTURE(on_gpu, as_it_wakes);
      CutInSleep run(on_gpu ? make_gpu_device(0) : make_cpu_device(1, 64), as_it_wakes);
      std::vector<glm::vec4> places = run.places();
      int steps = 1;
      for (; !run.make_step(true) && steps < 1500; ++steps) places = run.places();
      REQUIRE(steps < 1500);
      CHECK(run.status().asleep == 0);
      const auto control = [&] { return run.bench.bodies.control.download().front(); };
      CHECK(control().total_low[physics::reverted_vertices] == CutInSleep::cuts);
      CHECK(std::equal(places.begin(), places.begin() + CutInSleep::cuts, run.places().begin()));
      const bench::ApartOracle oracle(run.start.model);
      for (int step = 0; step < 5; ++step) {
        run.make_step(false);
        const double unheld = farthest_unheld(run.state(), run.start.model, CutInSleep::time_step);
        const double farthest = farthest_from(places, run.places(), run.start.model);
        CHECK(unheld > 5 * 9.81 * CutInSleep::time_step * CutInSleep::time_step);
        CHECK(farthest < 0.3 * unheld);
        CHECK(oracle.pairs_not_apart(run.state().world_positions(run.start.model)) == 0);
        CHECK(control().non_finite_step == 0);
      }
    }
}

// At 0.3 m a step it comes from beyond an edge of 0.24 m. A heavy ball stays slow, but not a light one.
TEST_CASE("a ball that is hit in the step in which it would fall asleep keeps what that gives, and stays awake") {
  const double step = 0.002, speed = 150;
  const auto device = make_cpu_device(1, 32);
  for (const double mass : {1.0, 1000.0}) {
    const BodySetup lying = of_mass(lying_ball({0, 0.412, 0}), mass);
    const std::uint64_t until_asleep = steps_to_sleep(on_floor({lying}), sleeping());
    REQUIRE(until_asleep < 1000);
    for (const std::uint64_t hit_in : {until_asleep - 1, until_asleep})
      for (const double distance : {0.26, 0.28}) {
        CAPTURE(mass, hit_in, distance);
        const double time = step * static_cast<double>(hit_in - 1);  // when that step begins
        BodySetup flying = of_mass(lying_ball({-0.8 - distance - speed * time, 0.412 + 9.81 * time * time / 2, 0}), 1 / mass);
        flying.description.velocity = {speed, 0, 0};
        const ModelAndState start = on_floor({lying, flying});
        Simulation simulation(*device, start.model, start.state, sleeping(), by_impulses);
        const Energies seen = energies_of(simulation, start, downward, time + 100 * step);
        CHECK(simulation.report().bodies_asleep == 0);
        CHECK(simulation.report().energy_slept < 1e-6 * mass);
        CHECK(glm::length(seen.momentum) < 1e-4 * mass);
      }
  }
}

// It may go up first. A cube stands flat on the slope, so that it slides without vibration.
TEST_CASE("what slides on a slope without friction never sleeps, however large it is and whichever way it goes") {
  const auto device = make_cpu_device(1, 32);
  for (const double slope : {0.11, 0.5})  // of gravity, along the slope
    for (const double speed : {0.0, 0.24, 0.45}) {
      CAPTURE(slope, speed);
      GroundDescription ground;
      ground.normal = {slope, std::sqrt(1 - slope * slope), 0};
      ground.surface.friction = 0;
      BodySetup large = lying_ball(26.45 * ground.normal);
      large.mesh = generate_mesh("cube:2");
      large.description.rotation = {0, 0, -glm::degrees(std::asin(slope))};
      large.description.scale = 50;
      large.description.total_mass = 1000;
      large.description.total_stiffness = 4e7;
      large.description.damping = 2000;
      large.description.velocity = speed * glm::dvec3(-ground.normal.y, ground.normal.x, 0);
      const ModelAndState start = build_model({&large, 1}, downward, {&ground, 1});
      TimePlan plan = sleeping(), without = sleeping();
      plan.time_step = without.time_step = 0.005;
      without.sleep = false;
      CollisionDescription smooth = by_impulses;
      smooth.friction = 0;
      Simulation simulation(*device, start.model, start.state, plan, smooth),
          never_sleeps(*device, start.model, start.state, without, smooth);
      for (Simulation* s : {&simulation, &never_sleeps}) s->advance(500);
      const bool is_same = simulation.state().motion == never_sleeps.state().motion;
      CHECK(is_same);
    }
}

// A cube stands on the floor. It has no damping, so that its vertices vibrate about where gravity bends it to, at up to several
// times g / omega.
ModelAndState vibrating_cube(double omega) {
  BodySetup cube = lying_ball({0, 0.41, 0});
  cube.mesh = generate_mesh("cube:2");
  cube.description.scale = 0.8;
  cube.description.total_stiffness = omega * omega;
  cube.description.damping = 0;
  return on_floor({cube});
}

// It may sleep if it moves by 0.07 m/s. It trembles at four times that in the mean of squares at most. The first one vibrates at
// 0.5 to 0.7 m/s. The other one vibrates at up to 0.1 m/s.
TEST_CASE("a body that vibrates strongly where it stands does not freeze, and one that trembles sleeps") {
  const auto device = make_cpu_device(1, 32);
  for (const double omega : {50.0, 300.0}) {
    CAPTURE(omega);
    const ModelAndState start = vibrating_cube(omega);
    Simulation simulation(*device, start.model, start.state, sleeping(), by_impulses);
    double fastest = 0, last = 0;  // of a vertex, and when one was faster than what may sleep
    while (simulation.report().time < 3 && simulation.report().bodies_asleep == 0) {
      fastest = 0;
      for (const glm::dvec3& velocity : simulation.state().world_velocities(start.model))
        fastest = std::max(fastest, glm::length(velocity));
      if (fastest > 0.07) last = simulation.report().time;
      simulation.advance(1);
    }
    CHECK(simulation.report().bodies_asleep == (omega == 50 ? 0 : 1));
    CHECK(last > simulation.report().time - 0.1);
  }
}

TEST_CASE("bodies that only hold each other do not sleep, and those that a static body bears do") {
  const auto device = make_cpu_device(1, 32);
  std::vector<BodySetup> drifting{lying_ball({0, 0, 0}), lying_ball({0.87, 0, 0})};
  drifting[0].description.velocity = {0.035, 0, 0};
  drifting[1].description.velocity = {-0.005, 0, 0};
  CollisionDescription plastic = by_impulses;
  plastic.elasticity = 0;
  GroundDescription far_below;
  far_below.point = {0, -10, 0};
  for (const bool has_ground : {false, true}) {
    CAPTURE(has_ground);
    const ModelAndState start =
        build_model(drifting, glm::dvec3(0.0), std::span(&far_below, has_ground ? std::size_t{1} : std::size_t{0}));
    TimePlan plan = sleeping();
    plan.time_step = 0.005;
    Simulation simulation(*device, start.model, start.state, plan, plastic);
    const Energies seen = energies_of(simulation, start, glm::dvec3(0.0), 6);
    CHECK(simulation.report().bodies_asleep == 0);
    CHECK(simulation.report().contact_steps > 0);
    CHECK(glm::length(seen.momentum) < 1e-6);
  }

  std::vector<BodySetup> borne{lying_ball({0, 0.45, 0}), soft(generate_mesh("cube:2"), "table")};
  borne[1].description.kind = BodyKind::immovable;
  borne[1].description.scale = 3;
  borne[1].description.position = {0, -1.5, 0};
  const ModelAndState start = build_model(borne, downward);
  Simulation simulation(*device, start.model, start.state, sleeping(), by_impulses);
  advance_to(simulation, 3);
  CHECK(simulation.report().bodies_asleep == 1);
}

TEST_CASE("momentum is what gravity and what does not move have given, though bodies fall asleep and wake") {
  const ModelAndState start =
      on_floor({lying_ball({0, 0.45, 0}), lying_ball({0.83, 0.45, 0}), lying_ball({3, 0.45, 0}), lying_ball({0.1, 16, 0})});
  const auto device = make_cpu_device(1, 32);
  for (const char* integrator : {"verlet", "cv8"}) {
    CAPTURE(integrator);
    Simulation simulation(*device, start.model, start.state, sleeping(integrator), by_impulses);
    advance_to(simulation, 1.7);
    REQUIRE(simulation.report().bodies_asleep == 3);
    const Energies seen = energies_of(simulation, start, downward, 2.2);
    CHECK(simulation.report().bodies_asleep < 3);
    CHECK(glm::length(seen.momentum) < 1e-5);  // of 86 Ns that gravity has given
  }
}

TEST_CASE("a body that is pulled, however gently, does not sleep") {
  const auto device = make_cpu_device(1, 32);
  const ModelAndState start = on_floor({lying_ball({0, 0.45, 0})});
  Simulation simulation(*device, start.model, start.state, sleeping(), by_impulses);
  advance_to(simulation, 3);
  REQUIRE(simulation.report().bodies_asleep == 1);
  const glm::dvec3 place = glm::dvec3(glm::vec3(simulation.world_positions()[3]));
  std::uint64_t asleep = 0;
  for (int step = 0; step < 1500; ++step) {
    simulation.pull({.vertex = 3, .target = place + glm::dvec3(1e-4, 0, 0)}, 0.002);
    simulation.advance(1);
    asleep += simulation.report().bodies_asleep;
  }
  CHECK(asleep == 0);
  advance_to(simulation, simulation.report().time + 10);
  CHECK(simulation.report().bodies_asleep == 1);
}

TEST_CASE("sleep gives the same bits on any number of threads, after saving, and with nothing skipped") {
  std::vector<BodySetup> balls{lying_ball({0, 0.45, 0}), lying_ball({0.83, 0.45, 0}), lying_ball({0.1, 8, 0})};
  const ModelAndState start = on_floor(balls);
  const auto one = make_cpu_device(1, 32), three = make_cpu_device(3, 32);
  Simulation whole(*one, start.model, start.state, sleeping(), by_impulses),
      shared_out(*three, start.model, start.state, sleeping(), by_impulses),
      does_all(*one, start.model, start.state, sleeping(), by_impulses),
      resumed(*one, start.model, start.state, sleeping(), by_impulses);
  does_all.skip(skip_nothing);
  for (Simulation* simulation : {&whole, &shared_out, &does_all}) simulation->advance(580);
  REQUIRE(whole.report().bodies_asleep == 2);
  resumed.restore(whole.save());
  for (Simulation* simulation : {&whole, &shared_out, &does_all, &resumed}) simulation->advance(300);
  CHECK(whole.report().bodies_asleep == 0);
  for (Simulation* other : {&shared_out, &does_all, &resumed}) {
    CHECK(other->state().motion == whole.state().motion);
    CHECK(other->report().steps_asleep == whole.report().steps_asleep);
  }
}

}  // namespace
}  // namespace pliant
