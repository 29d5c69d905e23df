#include "simulation/time_plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "dynamics/stability.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

SceneDescription scene_with(const std::string& integrator, DampingLaw law) {
  SceneDescription scene;
  scene.file = "scene.toml";
  scene.simulation.integrator = {integrator, {Origin::From::file, "scene.toml:3: simulation.integrator"}};
  scene.simulation.damping_law = law;
  return scene;
}

TEST_CASE("the automatic step is at most nine tenths of what a strained body bears and divides a frame evenly") {
  BodySetup setup = sphere(2);
  setup.description.stiffness = 40;
  const Model model = built(setup).model;
  for (const double frame_rate : {10.0, 24.0, 60.0, 1000.0}) {
    SceneDescription scene = scene_with("cv8", DampingLaw::none);
    scene.output.frame_rate = frame_rate;
    const TimePlan plan = plan_time(scene, model);
    const double steps_per_frame = 1 / (frame_rate * plan.time_step);
    CHECK(plan.step_bound == Approx(3.0018 / stiffest_omega(model)).epsilon(1e-4));
    const double longest = 0.9 * plan.integrator->strained_bound * plan.step_bound;
    CHECK(plan.time_step <= longest * (1 + 1e-12));
    CHECK(std::abs(steps_per_frame - std::round(steps_per_frame)) < 1e-9);
    if (steps_per_frame > 1.5) CHECK(1 / (frame_rate * (steps_per_frame - 1)) > longest);  // no longer step would do
    CHECK(plan.step_of_frame(7) == static_cast<std::uint64_t>(std::llround(7 * steps_per_frame)));
  }
}

TEST_CASE("the stiffest body sets the bound") {
  BodySetup soft = sphere(0), hard = sphere(0);
  hard.description.stiffness = 9;
  const std::vector<BodySetup> setups{soft, hard};
  const TimePlan plan = plan_time(scene_with("rk4", DampingLaw::none), build_model(setups, {0, 0, 0}).model);
  CHECK(plan.step_bound == Approx(step_bound(find_integrator("rk4"), 12 * 9.0, 0)));
}

// If planning searched once for each body, this would take over five minutes, ctest's limit.
TEST_CASE("twenty thousand bodies of two kinds are planned like two") {
  const auto model_of = [](std::size_t count) {
    std::vector<BodySetup> setups(count, two_vertices());
    for (std::size_t i = 1; i < count; i += 2) setups[i].description.damping = 3;
    return build_model(setups, {0, 0, 0}).model;
  };
  const SceneDescription scene = scene_with("dop853", DampingLaw::constant);
  CHECK(plan_time(scene, model_of(20'000)).step_bound == plan_time(scene, model_of(2)).step_bound);
}

TEST_CASE("bodies without springs or damping bound nothing, and a step is then a frame") {
  BodySetup setup = sphere(0);
  setup.description.stiffness = 0;
  const TimePlan plan = plan_time(scene_with("cv8", DampingLaw::none), built(setup).model);
  CHECK(std::isinf(plan.step_bound));
  CHECK(plan.time_step == Approx(1.0 / 60));
}

TEST_CASE("the step that an error advises for a body that turns is taken") {
  for (const double spin : {30.0, 100.0, 150.0, 200.0, 1000.0}) {
    CAPTURE(spin);
    BodySetup setup = sphere(0);
    setup.description.kind = BodyKind::scripted;
    setup.description.spin = {0, spin, 0};
    SceneDescription scene = scene_with("cv8", DampingLaw::none);
    scene.simulation.time_step = 2 / spin;
    const Model model = built(setup).model;
    const std::string said = error_of([&] { return plan_time(scene, model); }).what();
    const auto at = said.find("at most ");
    REQUIRE(at != std::string::npos);
    scene.simulation.time_step = std::stod(said.substr(at + 8));
    CHECK(plan_time(scene, model).time_step * spin > 0.8);
  }
}

TEST_CASE("a step turns a scripted body a little at most") {
  BodySetup setup = sphere(0);
  setup.description.kind = BodyKind::scripted;
  setup.description.spin = {0, 0, 30};
  SceneDescription scene = scene_with("cv8", DampingLaw::none);
  const Model model = built(setup).model;
  CHECK(30 * plan_time(scene, model).time_step <= 0.25);
  CHECK(30 * plan_time(scene, model).time_step > 0.1);
  scene.simulation.time_step = 0.03;
  CHECK(plan_time(scene, model).time_step == 0.03);
  scene.simulation.time_step = 0.04;
  check_says(error_of([&] { return plan_time(scene, model); }), {"turns by 1.2 rad in a step of 0.04 s", "at most 0.03"});
  scene.simulation.time_step.reset();
  scene.simulation.tolerance = 1e-5;
  scene.simulation.integrator.value = "dop853";
  CHECK(30 * plan_time(scene, model).step_bound <= 0.25 * (1 + 1e-6));
}

TEST_CASE("a strongly damped drift bounds the step too") {
  BodySetup setup = sphere(0);
  setup.description.stiffness = 1e-6;
  setup.description.damping = 2000;
  const TimePlan plan = plan_time(scene_with("cv8", DampingLaw::constant), built(setup).model);
  CHECK(plan.step_bound < 3.8 / 2000);
}

TEST_CASE("with a fixed step a frame is the first state at or after its time") {
  SceneDescription scene = scene_with("cv8", DampingLaw::none);
  scene.simulation.time_step = 0.007;
  scene.simulation.duration = 1;
  const TimePlan plan = plan_time(scene, built(sphere(0)).model);
  CHECK(plan.steps == 143);
  for (std::uint64_t frame = 0; frame < 60; ++frame) {
    const auto step = static_cast<double>(plan.step_of_frame(frame));
    CHECK(step * 0.007 >= static_cast<double>(frame) / 60 - 1e-8);
    CHECK((step - 1) * 0.007 < static_cast<double>(frame) / 60);
  }
}

TEST_CASE("frames advance at every frame rate that a scene may have") {
  for (const double frame_rate : {1e-6, 1.0, 1e6}) {
    for (const double time_step : {1e-30, 1e-3, 1.0}) {
      const TimePlan plan{.time_step = time_step, .frame_rate = frame_rate};
      CAPTURE(frame_rate, time_step);
      CHECK(plan.step_of_frame(0) == 0);
      CHECK(plan.step_of_frame(1) >= 1);
      CHECK(plan.step_of_frame(1) <= 1'000'000'000'000'000'000u);
      for (const std::uint64_t frame : {3u, 7u, 299'999'999u})
        if (frame_rate * time_step == 1) CHECK(plan.step_of_frame(frame) == frame);
    }
  }
}

TEST_CASE("the next step with a frame is the first after a step, or the next one where steps are longer than frames") {
  for (const double time_step : {1e-30, 1e-4, 0.007, 1.0 / 60, 0.3, 1e30}) {
    const TimePlan plan{.time_step = time_step};
    CAPTURE(time_step);
    std::uint64_t step = 0, frame = 0;
    for (int k = 0; k < 100 && step < 300'000'000; ++k) {
      const std::uint64_t next = plan.next_frame_step(step);
      if (60 * time_step >= 1)
        CHECK(next == step + 1);
      else
        CHECK(next == plan.step_of_frame(++frame));
      step = next;
    }
  }
}

TEST_CASE("bodies without damping are undamped under every law") {
  BodySetup setup = sphere(0);
  setup.description.damping = 0;
  const Model model = built(setup).model;
  CHECK(plan_time(scene_with("srkn11b", DampingLaw::adaptive), model).damping_law == DampingLaw::none);
  setup.description.damping = 1e-3;
  CHECK(plan_time(scene_with("cv8", DampingLaw::adaptive), built(setup).model).damping_law == DampingLaw::adaptive);
}

TEST_CASE("an integrator that no one knows, or that cannot meet damping, is an input error where the scene names it") {
  const Model model = built(sphere(0)).model;
  const auto unknown = error_of([&] { return plan_time(scene_with("euler", DampingLaw::none), model); });
  CHECK(unknown.kind() == ErrorKind::input);
  check_says(unknown, {"scene.toml:3", "euler", "verlet", "cv8"});
  const auto unstable = error_of([&] { return plan_time(scene_with("srkn11b", DampingLaw::adaptive), model); });
  CHECK(unstable.kind() == ErrorKind::input);
  check_says(unstable, {"scene.toml:3", "srkn11b", "damping"});
  const auto without_velocities = error_of([&] { return plan_time(scene_with("dprkn12", DampingLaw::adaptive), model); });
  CHECK(without_velocities.kind() == ErrorKind::input);
  check_says(without_velocities, {"scene.toml:3", "dprkn12", "velocities", "\"constant\"", "verlet"});
  for (const char* name : {"srkn11b", "dprkn8", "dprkn12"}) {
    const auto refused = error_of([&] { return plan_time(scene_with(name, DampingLaw::internal), model); });
    CHECK(refused.kind() == ErrorKind::input);
    check_says(refused, {"scene.toml:3", name, "damping", "verlet"});
  }
  check_says(error_of([&] { return plan_time(scene_with("dprkn8", DampingLaw::internal), model); }), {"internal damping"});
  for (const char* name : {"srkn11b", "dprkn12"}) CHECK_NOTHROW(plan_time(scene_with(name, DampingLaw::none), model));
  CHECK_NOTHROW(plan_time(scene_with("dprkn12", DampingLaw::constant), model));
}

TEST_CASE("a Nystrom method meets constant damping at fixed steps alone, and as many rates as it has room for") {
  SceneDescription scene = scene_with("dprkn8", DampingLaw::constant);
  scene.collision.response.value = "reflect";  // contact by impulses divides steps
  std::vector<BodySetup> bodies(14, sphere(0));
  for (std::size_t b = 0; b < bodies.size(); ++b) bodies[b].description.damping = 1e-3 * static_cast<double>(b % 13);
  const auto crowded = error_of([&] { return plan_time(scene, build_model(bodies, glm::dvec3(0.0)).model); });
  CHECK(crowded.kind() == ErrorKind::input);
  check_says(crowded, {"scene.toml:3", "room for 11 rates", "have 13", "dop853"});
  scene.simulation.integrator.value = "dprkn12";
  bodies.resize(3);
  const auto few = error_of([&] { return plan_time(scene, build_model(bodies, glm::dvec3(0.0)).model); });
  check_says(few, {"room for 2 rates", "have 3", "such as dprkn8"});
  scene.simulation.integrator.value = "dprkn8";
  bodies.resize(11, sphere(0));
  CHECK_NOTHROW(plan_time(scene, build_model(bodies, glm::dvec3(0.0)).model));
  scene.simulation.tolerance = 1e-6;
  const auto varied = error_of([&] { return plan_time(scene, build_model(bodies, glm::dvec3(0.0)).model); });
  CHECK(varied.kind() == ErrorKind::input);
  check_says(varied, {"scene.toml:3", "dprkn8", "one length", "one of dop853, verner78_8, vern8;"});
}

TEST_CASE("steps too long for a Nystrom method to resolve the damping are an input error, and the automatic one is none") {
  BodySetup setup = sphere(0);
  setup.description.damping = 1000;
  const Model model = built(setup).model;
  for (const char* name : {"dprkn8", "dprkn12"}) {
    SceneDescription scene = scene_with(name, DampingLaw::constant);
    scene.simulation.time_step = 0.05;
    const auto coarse = error_of([&] { return plan_time(scene, model); });
    CHECK(coarse.kind() == ErrorKind::input);
    check_says(coarse, {"scene.toml:3", name, "0.05 s", "stop short", "verlet"});
    scene.simulation.time_step = {};
    const double bound = drag_bound(find_integrator(name), model.bodies.front(), DampingLaw::constant);
    CHECK(plan_time(scene, model).time_step <= bound);
    CHECK(plan_time(scene, model).time_step > 0.5 * bound);
  }
}

TEST_CASE("contact by impulses takes any method whose steps can be divided") {
  std::vector<BodySetup> setups(2, sphere(0));
  for (BodySetup& setup : setups) setup.description.damping = 0.01;
  const Model model = build_model(setups, glm::dvec3(0.0)).model;
  SceneDescription scene = scene_with("dprkn8", DampingLaw::constant);
  CHECK_NOTHROW(plan_time(scene, built(setups.front()).model));  // there is nothing to touch
  check_says(error_of([&] { return plan_time(scene, model); }), {"scene.toml:3", "dprkn8", "choose another integrator"});
  scene.simulation.damping_law = DampingLaw::none;
  CHECK_NOTHROW(plan_time(scene, model));
  scene.simulation.damping_law = DampingLaw::constant;
  scene.simulation.integrator.value = "dop853";
  CHECK_NOTHROW(plan_time(scene, model));
}

TEST_CASE("a scene that names no damping law has internal damping in gravity where bodies meet by impulses") {
  const Model model = built(sphere(0)).model;
  const auto law_with = [&](const char* response, const glm::dvec3& acceleration) {
    SceneDescription scene;
    scene.collision.response.value = response;
    scene.simulation.gravity = acceleration;
    return plan_time(scene, model).damping_law;
  };
  const glm::dvec3 none(0.0), down(0, -9.81, 0);
  CHECK(law_with("impulse", down) == DampingLaw::internal);
  for (const char* response : {"reflect", "none"}) CHECK(law_with(response, down) == DampingLaw::adaptive);
  for (const char* response : {"impulse", "reflect", "none"}) CHECK(law_with(response, none) == DampingLaw::adaptive);
}

TEST_CASE(
    "a method that refuses damping takes undamped bodies in gravity, and damped ones are an error with a remedy that works") {
  for (const char* name : {"srkn11b", "dprkn8", "dprkn12"})
    for (const std::size_t count : {1u, 2u}) {
      CAPTURE(name, count);
      SceneDescription scene = scene_with(name, DampingLaw::none);
      scene.simulation.damping_law.reset();
      scene.simulation.gravity = {0, -9.81, 0};
      std::vector<BodySetup> setups(count, sphere(0));
      const Model damped = build_model(setups, scene.simulation.gravity).model;
      for (BodySetup& setup : setups) setup.description.damping = 0;
      const Model undamped = build_model(setups, scene.simulation.gravity).model;
      CHECK(plan_time(scene, undamped).damping_law == DampingLaw::none);
      const std::string remedy = count == 1 && scene.simulation.integrator.value != "srkn11b" ? "constant" : "none";
      check_says(error_of([&] { return plan_time(scene, damped); }), {"scene.toml:3", name, remedy.c_str()});
      scene.simulation.damping_law = remedy == "constant" ? DampingLaw::constant : DampingLaw::none;
      CHECK_NOTHROW(plan_time(scene, damped));
    }
}

TEST_CASE("with a tolerance frames are exact, and the first step stays far below the bound") {
  SceneDescription scene = scene_with("dop853", DampingLaw::none);
  scene.simulation.tolerance = 1e-6;
  scene.simulation.duration = 0.7;
  const TimePlan plan = plan_time(scene, built(sphere(0)).model);
  CHECK(plan.tolerance == 1e-6);
  CHECK(plan.time_step <= 0.1 * plan.step_bound);
  CHECK(plan.steps == 0);
  for (std::uint64_t frame = 0; frame <= 42; ++frame) CHECK(plan.time_of_frame(frame) == static_cast<double>(frame) / 60);
  CHECK(plan.time_of_frame(42) == plan.duration);
  CHECK_FALSE(plan.time_of_frame(43));
}

TEST_CASE("a tolerance needs a method that estimates its error, and the remedy lists those") {
  const Model model = built(sphere(0)).model;
  for (const Integrator& integrator : integrators()) {
    CAPTURE(integrator.name);
    SceneDescription scene = scene_with(std::string(integrator.name), DampingLaw::none);
    scene.simulation.tolerance = 1e-6;
    if (estimates_error(integrator)) {
      CHECK_NOTHROW(plan_time(scene, model));
      continue;
    }
    const Error error = error_of([&] { return plan_time(scene, model); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"scene.toml:3", "--integrator auto", "dop853, verner78_8, vern8, dprkn8, dprkn12", "time_step"});
  }
}

TEST_CASE("an automatic integrator estimates its error, whatever the law and the tolerance, and needs one") {
  const Model model = built(sphere(0)).model;
  for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive, DampingLaw::internal}) {
    SceneDescription scene = scene_with("auto", law);
    const Error error = error_of([&] { return plan_time(scene, model); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"scene.toml:3", "auto", "tolerance"});
    for (const double tolerance : {1e-14, 1e-7, 1e-6, 1e-3, 0.1}) {
      scene.simulation.tolerance = tolerance;
      CHECK(estimates_error(*plan_time(scene, model).integrator));
    }
  }
}

TEST_CASE("a tolerance below what fp32 carries is an error where it stands, unless forces are in fp64") {
  const Model model = built(sphere(0)).model;
  struct Case {
    const char* integrator;
    double smallest;
    const char* says;
  };
  for (const auto& [integrator, smallest, says] : {Case{"dop853", 1e-7, "1e-07"}, Case{"vern8", 1e-6, "1e-06"}}) {
    SceneDescription scene = scene_with(integrator, DampingLaw::none);
    const auto check_carried = [&](int precision) {
      expect_carried(scene, plan_time(scene, model), precision);
      return 0;
    };
    CHECK_NOTHROW(check_carried(32));
    scene.simulation.tolerance_where = {Origin::From::file, "scene.toml:4: simulation.tolerance"};
    scene.simulation.tolerance = smallest;
    CHECK_NOTHROW(check_carried(32));
    scene.simulation.tolerance = 0.99 * smallest;
    CHECK_NOTHROW(check_carried(64));
    const Error error = error_of([&] { return check_carried(32); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"scene.toml:4", "fp32", integrator, says, "--precision 64"});
    scene.simulation.integrator.where = scene.simulation.tolerance_where = option_origin("--tolerance");
    CHECK(error_of([&] { return check_carried(32); }).kind() == ErrorKind::command_line);
  }
}

TEST_CASE("a scene's method that can't meet the tolerance of an option gives way, and one that an option names does not") {
  BodySetup setup = sphere(0);
  setup.description.damping = 3;
  const Model model = built(setup).model;
  for (const Integrator& integrator : integrators())
    for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive, DampingLaw::internal}) {
      CAPTURE(integrator.name, static_cast<int>(law));
      SceneDescription scene = scene_with(std::string(integrator.name), law);
      scene.simulation.tolerance = 1e-4;
      scene.simulation.tolerance_where = option_origin("--tolerance");
      const Integrator& taken = *plan_time(scene, model).integrator;
      CHECK(estimates_error(taken));
      CHECK(allows_damping(taken, law));
      scene.simulation.integrator.where = option_origin("--integrator");
      if (&taken == &integrator)
        CHECK_NOTHROW(plan_time(scene, model));
      else
        check_says(error_of([&] { return plan_time(scene, model); }), {"--integrator", "auto", "dop853"});
    }
}

TEST_CASE("the first step of a tolerance is no longer than a frame, and the run has a limit") {
  const Model model = built(sphere(0)).model;
  SceneDescription scene = scene_with("dop853", DampingLaw::none);
  scene.simulation.tolerance = 1e-6;
  scene.output.frame_rate = 1e6;
  scene.simulation.duration = 100;
  CHECK(plan_time(scene, model).time_step <= 1e-6);
  scene.simulation.duration = 301;
  check_says(error_of([&] { return plan_time(scene, model); }), {"3e8 steps", "frame_rate"});
}

TEST_CASE("the body that needs so many steps is named, unless the scene says how long a step is") {
  std::vector<BodySetup> setups = {sphere(0), sphere(0), sphere(0)};
  const char* names[] = {"soft", "light", "heavy"};
  for (std::size_t k = 0; k < setups.size(); ++k) setups[k].description.name = names[k];
  setups[1].description.vertex_mass = 1e-20;
  setups[2].description.vertex_mass = 100;
  const Model model = build_model(setups, glm::dvec3(0.0)).model;
  SceneDescription scene = scene_with("cv8", DampingLaw::none);
  const Error error = error_of([&] { return plan_time(scene, model); });
  check_says(error, {"3e8 steps", "body \"light\" needs them", "raise its mass"});
  scene.simulation.time_step = 1e-12;
  CHECK(std::string(error_of([&] { return plan_time(scene, model); }).what()).find("light") == std::string::npos);
}

TEST_CASE("a number of steps and a tolerance exclude each other") {
  SceneDescription scene = scene_with("dop853", DampingLaw::none);
  scene.simulation.tolerance = 1e-6;
  const Error error = error_of([&] { return plan_time(scene, built(sphere(0)).model, 10); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"--steps", "--duration"});
}

TEST_CASE("more steps than the device's clock counts are the fault of who set the length") {
  SceneDescription scene = scene_with("cv8", DampingLaw::none);
  scene.simulation.time_step = 1e-12;
  const Model model = built(sphere(0)).model;
  const auto failure = [&] { return error_of([&] { return plan_time(scene, model); }); };
  CHECK(failure().kind() == ErrorKind::input);
  check_says(failure(), {"scene.toml: ", "3e8"});
  scene.simulation.time_step_where = {Origin::From::file, "scene.toml:3: simulation.time_step"};
  scene.simulation.duration_where = {Origin::From::file, "scene.toml:2: simulation.duration"};
  check_says(failure(), {"scene.toml:2: "});
  scene.simulation.time_step_where = {Origin::From::override, "--set simulation.time_step=1e-12: simulation.time_step"};
  CHECK(failure().kind() == ErrorKind::command_line);
  check_says(failure(), {"--set simulation.time_step"});
  scene.simulation.duration_where = option_origin("--duration");
  check_says(failure(), {"--duration: "});
}

}  // namespace
}  // namespace pliant
