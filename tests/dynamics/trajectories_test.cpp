// How far fp32 forces lead a trajectory from that of fp64.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/evolve.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

// A sphere flattened along x by `amplitude`, and let go.
ModelAndState flattened_sphere(int level, double amplitude) {
  BodySetup setup = sphere(level);
  setup.description.stretch = {1 - amplitude, 1, 1};
  return built(setup);
}

// The distance of two states in (u, v / omega), relative to the second's own size.
double relative_distance(const ModelAndState& start, const State& a, const State& b) {
  const double omega = stiffest_omega(start.model);
  const std::vector<glm::dvec3> x = a.world_positions(start.model), y = b.world_positions(start.model),
                                v = a.world_velocities(start.model), w = b.world_velocities(start.model);
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 u = y[i] - glm::dvec3(start.model.rest_positions[i]);
    const glm::dvec3 dx = x[i] - y[i], dv = (v[i] - w[i]) / omega;
    apart += glm::dot(dx, dx) + glm::dot(dv, dv);
    size += glm::dot(u, u) + glm::dot(w[i], w[i]) / (omega * omega);
  }
  return std::sqrt(apart / size);
}

// Rounding of forces leaves sums that are not zero, and nothing holds a body back from drifting. A body of fewer vertices drifts
// further. A CPU sums in another order than a GPU, with more rounding.
struct Bounds {
  double cpu, gpu;
};

void check_trajectories(int level, const Bounds& bounds) {
  for (const double amplitude : {0.2, 0.1, 1e-2, 1e-3, 1e-4}) {
    const ModelAndState start = flattened_sphere(level, amplitude);
    const Method method{"cv8", 0.5 / stiffest_omega(start.model)};
    const State exact = evolve(*make_cpu_device(2, 64), start, method, 200);
    for (const TestDevice& test : all_devices()) {
      CAPTURE(test.name, start.model.vertex_count(), amplitude);
      CHECK(relative_distance(start, evolve(*test.device, start, method, 200), exact) <
            (test.name == "gpu" ? bounds.gpu : bounds.cpu));
    }
  }
}

// The bounds are twice what was measured on CPU, llvmpipe and an H200.
TEST_CASE("fp32 forces keep small bodies near the fp64 trajectory", "[gl]") {
  check_trajectories(0, {4e-6, 2.2e-6});
  check_trajectories(1, {2.5e-6, 6e-7});
  check_trajectories(2, {9e-7, 4e-7});
}

struct Cancelling {
  const char* integrator;
  double omega_step, bound;
};

// A bound lies midway, by factors, between two measurements on llvmpipe: roundings of placements cancel in one and add up in the
// other. Large weights that nearly cancel, dop853's and above all vern8's, magnify what is left.
void check_cancelling(std::initializer_list<Cancelling> cases) {
  const std::vector<TestDevice> devices = all_devices();
  if (devices.back().name != "gpu") return test::skip("there is no OpenGL to measure on");
  for (const auto& [integrator, omega_step, bound] : cases) {
    double sum = 0;
    for (const double amplitude : {0.2, 0.15, 0.1}) {
      const ModelAndState start = flattened_sphere(2, amplitude);
      const Method method{integrator, omega_step / stiffest_omega(start.model)};
      const State exact = evolve(*make_cpu_device(2, 64), start, method, 200);
      sum += std::pow(relative_distance(start, evolve(*devices.back().device, start, method, 200), exact), 2);
    }
    CAPTURE(integrator);
    CHECK(std::sqrt(sum / 3) < bound);
  }
}

TEST_CASE("within a step roundings of placements cancel", "[gl]") { check_cancelling({{"cv8", 0.5, 1.9e-7}}); }

TEST_CASE("within a step roundings of placements cancel, by every method's own weights", "[gl][long]") {
  check_cancelling(
      {{"dop853", 0.5, 2.3e-6}, {"vern8", 0.5, 1.7e-5}, {"rk4", 1, 7e-7}, {"dprkn8", 1, 9e-7}, {"dprkn12", 1, 1.2e-6}});
}

TEST_CASE("fp32 forces on a GPU keep a body of 642 vertices within 1e-7 of the fp64 trajectory", "[gl][long]") {
  check_trajectories(3, {6e-7, 1e-7});
}

}  // namespace
}  // namespace pliant
