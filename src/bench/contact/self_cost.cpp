#include "bench/contact/self_cost.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bench/common/timing.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr int windows = 31, warming_windows = 8;
constexpr std::uint64_t steps_of_a_window = 8;
constexpr double omega_step = 0.3;

ModelAndState body_of(const std::string& mesh, bool rests, bool self_contact) {
  BodySetup setup{.mesh = generate_mesh(mesh), .description = {}};
  setup.description.name = mesh;
  setup.description.total_mass = 1;
  setup.description.total_stiffness = 1e3;
  setup.description.damping = 0.02;
  setup.description.self_contact = self_contact;
  setup.description.stretch = {1.1, 1, 0.95};
  if (!rests) setup.description.spin = {0.5, 1, 0};
  double lowest = 0;
  for (const glm::dvec3& p : setup.mesh.positions) lowest = std::min(lowest, p.y);
  setup.description.position.y = 0.02 - lowest;
  const std::array<GroundDescription, 1> ground;
  return build_model({&setup, 1}, {0, rests ? -9.81 : 0, 0}, std::span(ground).first(rests ? 1 : 0));
}

// One body that moves on.
class Mover {
 public:
  Mover(Device& device, const std::string& mesh, bool rests, bool self_contact)
      : device_(device),
        start_(body_of(mesh, rests, self_contact)),
        simulation_(device, start_.model, start_.state,
                    {.integrator = &find_integrator("cv8"),
                     .time_step = omega_step / stiffest_frequency(start_.model.bodies.front()),
                     .damping_law = rests ? DampingLaw::internal : DampingLaw::none},
                    {.response = {"impulse"}}) {}

  // Returns the microseconds of a part of a step.
  double watch() {
    const std::uint64_t before = parts();
    Stopwatch stopwatch;
    stopwatch.time([&] {
      simulation_.advance(steps_of_a_window);
      device_.finish();
    });
    return 1e6 * stopwatch.seconds() / static_cast<double>(parts() - before);
  }

  StepReport report() { return simulation_.report(); }
  [[nodiscard]] std::size_t vertices() const { return start_.model.vertex_count(); }

 private:
  std::uint64_t parts() {
    const StepReport report = simulation_.report();
    return report.steps + report.substeps;
  }

  Device& device_;
  ModelAndState start_;
  Simulation simulation_;
};

}  // namespace

SelfCostRow measure_self_cost(Device& device, const std::string& mesh, bool rests) {
  Mover without(device, mesh, rests, false), with(device, mesh, rests, true);
  std::vector<double> times_without, times_with;
  for (int k = 0; k < windows; ++k) {
    const double first = without.watch(), second = with.watch();
    if (k < warming_windows) continue;
    times_without.push_back(first);
    times_with.push_back(second);
  }
  return {.mesh = mesh,
          .device = device.info().kind,
          .precision = device.precision(),
          .vertices = with.vertices(),
          .rests = rests,
          .cut_vertices = with.report().reverted_vertices,
          .microseconds_without = median(std::move(times_without)),
          .microseconds = median(std::move(times_with))};
}

}  // namespace pliant::bench
