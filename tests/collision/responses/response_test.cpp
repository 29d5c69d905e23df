// What every response of the list promises. The tests' own response is a row like the others.
#include "collision/responses/response.hpp"

#include <catch2/catch.hpp>

#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "support/collision_scene.hpp"
#include "support/expect_error.hpp"
#include "support/own_rows.hpp"

namespace pliant {
namespace {

TEST_CASE("a response that there is not is an error that lists those there are") {
  const Error error = error_of([] {
    return find_response({"bounce", {Origin::From::file, "scene.toml:2: collision.response"}});
  });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"scene.toml:2: collision.response", "bounce", "none, reflect"});
}

TEST_CASE("a response that there is not is an error where a lone body has nothing to touch, too") {
  const auto device = make_cpu_device(1, 32);
  const ModelAndState start = built(sphere(0));
  const TimePlan plan = plan_of(Method{"verlet", 0.01});
  CHECK_THROWS_AS(Simulation(*device, start.model, start.state, plan, {.response = {"bounce"}}), Error);
  CHECK_NOTHROW(Simulation(*device, start.model, start.state, plan, {.response = {"impulse"}}));
}

struct Outcome {
  State state;
  StepReport report;
};

Outcome after_collision(Device& device, std::string_view response) {
  const ModelAndState start = build_model(colliding_spheres(), glm::dvec3(0.0));
  Simulation simulation(device, start.model, start.state, plan_of(Method{"verlet", 0.01}), {.response = {std::string(response)}});
  simulation.advance(40);
  return {simulation.state(), simulation.report()};
}

TEST_CASE("a response is found by its row's name, meets contacts, and gives the same bits on any number of threads") {
  add_own_rows();
  CHECK(find_response({"halt"}).make != nullptr);
  for (const ResponseRow& row : responses()) {
    CAPTURE(row.name);
    const auto one = make_cpu_device(1, 32), three = make_cpu_device(3, 32);
    const Outcome first = after_collision(*one, row.name);
    CHECK(first.report.contact_steps > 0);
    const Outcome second = after_collision(*three, row.name);
    CHECK(first.state.motion == second.state.motion);
    CHECK(first.report == second.report);
    CHECK(first.state.motion != after_collision(*one, "none").state.motion);
  }
}

TEST_CASE("a response acts alike on every device", "[gl]") {
  add_own_rows();
  const ModelAndState start = build_model(colliding_spheres(), glm::dvec3(0.0));
  for (const ResponseRow& row : responses()) {
    const auto expected = after_collision(*make_cpu_device(1, 32), row.name).state.world_positions(start.model);
    for (const TestDevice& test : all_devices()) {
      CAPTURE(row.name, test.name);
      CHECK(distance(after_collision(*test.device, row.name).state.world_positions(start.model), expected) < 1e-4);
    }
  }
}

TEST_CASE("none is no response, and every row is found by its name") {
  CHECK(find_response({"none"}).make == nullptr);
  for (const ResponseRow& row : responses()) CHECK(&find_response({std::string(row.name)}) == &row);
}

const std::string smallest = "[[body]]\nmesh = \"icosphere:1\"\n", plate = smallest + "kind = \"static\"\n";

SceneDescription scene_of(const std::string& text, const std::string& response) {
  return parse_scene("[collision]\nresponse = \"" + response + "\"\n" + text, "scene.toml", {});
}

TEST_CASE("what never moves needs a response that allows it") {
  for (const std::string response : {"reflect", "none"}) {
    CAPTURE(response);
    const auto check_refused = [&](const std::string& text, std::initializer_list<const char*> parts) {
      const Error error = error_of([&] { return response_of(scene_of(text, response)); });
      CHECK(error.kind() == ErrorKind::input);
      check_says(error, parts);
      check_says(error, {response.c_str(), "; write response = \"impulse\""});
    };
    check_refused("[[ground]]\n" + smallest, {"scene.toml:3:", "ground"});
    check_refused(plate, {"scene.toml:5:", "body.body0.kind", "can't be static"});
    CHECK(response_of(scene_of(smallest, response)).name == response);
  }
  CHECK(response_of(scene_of("[[ground]]\n" + plate, "impulse")).name == "impulse");
}

TEST_CASE("self-contact needs contact by impulses") {
  const std::string text = smallest + "self_contact = true\n";
  for (const std::string response : {"reflect", "none"})
    check_says(error_of([&] { return response_of(scene_of(text, response)); }),
               {"scene.toml:5: body.body0.self_contact", response.c_str(), "remove self_contact", "response = \"impulse\""});
  CHECK(response_of(scene_of(text, "impulse")).name == "impulse");
}

TEST_CASE("brute force needs a response that allows it") {
  const std::string text = "search = \"brute_force\"\n" + smallest;
  check_says(error_of([&] { return response_of(scene_of(text, "impulse")); }),
             {"scene.toml:3:", "trees alone", "; remove search", "response = \"reflect\""});
  CHECK(response_of(scene_of(text, "reflect")).name == "reflect");
}

TEST_CASE("a mistyped response is named as such, also where a body is static") {
  const SceneDescription scene = scene_of(plate, "impuls");
  const Model model = build_model(load_bodies(scene), glm::dvec3(0.0)).model;
  const Error error = error_of([&] { return plan_time(scene, model); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"scene.toml:2: collision.response", "there is no response \"impuls\"", "none, reflect, impulse"});
}

TEST_CASE("a response of another program may allow static bodies and grounds") {
  add_own_rows();
  const SceneDescription scene =
      scene_of("[[ground]]\nheight = -9\n" + plate + smallest + "position = [0, 2.05, 0]\nvelocity = [0, -4, 0]\n", "halt");
  const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_time(scene, start.model), scene.collision);
  simulation.advance(20);
  CHECK(simulation.report().contact_steps > 0);
  CHECK_FALSE(simulation.report().breakdown);
}

TEST_CASE("elasticity and damping law have the default of the response, unless the scene names them") {
  add_own_rows();
  const auto check_defaults = [](const std::string& response, double elasticity, DampingLaw law) {
    CAPTURE(response);
    SceneDescription scene = scene_of(smallest, response);
    CHECK(elasticity_of(scene.collision) == elasticity);
    CHECK(damping_law_of(scene) == DampingLaw::adaptive);
    scene.simulation.gravity = {0, -9.81, 0};
    CHECK(damping_law_of(scene) == law);
    scene.collision.elasticity = 0.25;
    scene.simulation.damping_law = DampingLaw::none;
    CHECK(elasticity_of(scene.collision) == 0.25);
    CHECK(damping_law_of(scene) == DampingLaw::none);
  };
  check_defaults("impulse", 0.5, DampingLaw::internal);
  check_defaults("reflect", 0.9, DampingLaw::adaptive);
  check_defaults("none", 0.9, DampingLaw::adaptive);
  check_defaults("halt", 0.75, DampingLaw::constant);
}

}  // namespace
}  // namespace pliant
