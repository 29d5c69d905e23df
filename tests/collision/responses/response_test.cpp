// What every response of the list promises. The tests' own response is a row like the others.
#include "collision/responses/response.hpp"

#include <catch2/catch.hpp>

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
  CHECK(find_response({"halt"}) != nullptr);
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
  CHECK(find_response({"none"}) == nullptr);
  for (const ResponseRow& row : responses()) CHECK(find_response({std::string(row.name)}) == &row);
}

}  // namespace
}  // namespace pliant
