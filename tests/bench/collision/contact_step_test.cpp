// Steps in contact as the suite `collision` measures them: which passes its figures sum. How fast they are is no matter here.
#include "bench/collision/contact_step.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "bench/collision/spheres.hpp"
#include "dynamics/integrator.hpp"
#include "simulation/simulation.hpp"
#include "support/has.hpp"

namespace pliant::bench {
namespace {

TEST_CASE("spheres that press each other have contacts, and all figures of their steps") {
  const ContactStepRow row = measure_contact_step({.threads = 2}, 4, true);
  CHECK((row.device == DeviceKind::cpu && row.threads == 2 && row.triangles == 5120));
  CHECK(row.pressing_contacts > 10);
  CHECK(row.breakdown == "");
  double sum = 0;
  for (std::size_t k = 0; k < contact_groups().size(); ++k) {
    const auto& [group, seconds] = row.seconds.at(k);
    CAPTURE(group);
    CHECK(group == contact_groups()[k].name);
    CHECK(seconds > 0);
    sum += seconds;
  }
  CHECK(sum < row.step_seconds);  // springs take most of it
}

TEST_CASE("pressed spheres do not intersect at the start, and keep apart") {
  const ModelAndState start = pressed_spheres(3);
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, {.integrator = &find_integrator("verlet"), .time_step = 1e-4},
                        {.response = {"impulse"}});
  CHECK(simulation.intersections().pairs == 0);
  simulation.advance(2);
  CHECK(simulation.intersections().pairs == 0);
  CHECK(simulation.report().held_parts == 0);
}

TEST_CASE("pressed spheres of any size press each other on a GPU, too, and stay finite", "[gl]") {
  if (test::lacks_gl()) return;
  for (const int level : {3, 4, 5}) {
    CAPTURE(level);
    const ContactStepRow row = measure_contact_step({.device = DeviceKind::gpu}, level, true);
    CHECK(row.breakdown == "");
    CHECK(row.pressing_contacts > 10);
  }
}

TEST_CASE("each pass that contact by impulses has for two bodies is in one group of figures") {
  const ModelAndState start = pressed_spheres(3);
  const auto device = make_cpu_device(1, 32);
  const Simulation simulation(*device, start.model, start.state, {.integrator = &find_integrator("verlet"), .time_step = 1e-4},
                              {.response = {"impulse"}});
  std::multiset<std::string_view> grouped;
  for (const PassGroup& group : contact_groups()) grouped.insert(group.passes.begin(), group.passes.end());
  const Response& response = *simulation.collider().response();
  for (const std::vector<Pass>& passes : {response.before_step(0), response.after_step(0)})
    for (const Pass& pass : passes) {
      CAPTURE(pass.name);
      CHECK(grouped.count(pass.name) == 1);
    }
}

}  // namespace
}  // namespace pliant::bench
