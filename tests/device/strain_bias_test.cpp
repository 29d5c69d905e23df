#include <catch2/catch.hpp>
#include <cmath>

#include "support/evolve.hpp"

namespace pliant {
namespace {

// Forces are scaled by the bias. Those of many springs therefore agree with fp64 far better than one spring does.
TEST_CASE("forces of a body are neither too large nor too small on average", "[gl]") {
  BodySetup setup = sphere(3);
  setup.description.stretch = {1.02, 0.99, 1.01};
  const ModelAndState start = built(setup);
  const Method method{"verlet", 1e-3 / stiffest_omega(start.model)};
  const std::vector<glm::dvec3> exact = evolve(*make_cpu_device(2, 64), start, method, 1).world_velocities(start.model);
  for (const TestDevice& test : all_devices()) {
    const std::vector<glm::dvec3> velocities = evolve(*test.device, start, method, 1).world_velocities(start.model);
    double excess = 0, whole = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      excess += glm::dot(velocities[i] - exact[i], exact[i]);
      whole += glm::dot(exact[i], exact[i]);
    }
    CAPTURE(test.name, excess / whole);
    CHECK(std::abs(excess / whole) < 4e-9);
  }
}

TEST_CASE("a GPU's roots and quotients are off by less than a rounding on average", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CHECK(std::abs(test.device->strain_bias()) < 6e-8);
  }
}

}  // namespace
}  // namespace pliant
