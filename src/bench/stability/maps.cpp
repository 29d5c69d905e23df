// The suite `stability`: finds how motions end, by step and damping.
#include <algorithm>
#include <cmath>

#include "bench/stability/tasks.hpp"
#include "dynamics/stability.hpp"

namespace pliant::bench {
namespace {

void add_cell(StabilityTasks& tasks, const Integrator& integrator, const Sphere& shape, DampingLaw law, double damping,
              double part) {
  Sphere body = shape;
  body.damping = damping;
  body.squash = 0.2;
  body.velocity = {1, 0, 0};
  constexpr std::uint64_t steps = 400;
  const Place place = tasks.places()[tasks.places().size() > 1 ? 1 : 0];  // fp32 on the CPU, if the CPU is asked for
  tasks.add("map", integrator, place, body.vertex_count(), steps, [=, &integrator](Device& device) {
    const double undamped = step_bound(integrator, body.body(), DampingLaw::none);
    const Verdict verdict = judge(device, body.build(), plan_of(integrator, law, part * undamped), steps);
    return MapRow{std::string(integrator.name),
                  place.device,
                  place.precision,
                  body.vertex_count(),
                  body.stiffness,
                  name_of(law),
                  damping,
                  part * undamped,
                  undamped,
                  std::min(step_bound(integrator, body.body(), law), drag_bound(integrator, body.body(), law)),
                  steps,
                  verdict.outcome,
                  verdict.energy_ratio};
  });
}

// Returns the middles of `count` intervals from 0.1 to 4 of the undamped bound. If `count` is a multiple of 8, the bound lies
// between two of them.
std::vector<double> parts(int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(0.1 * std::pow(40.0, (i + 0.5) / count));
  return all;
}

void add_dampings(StabilityTasks& tasks) {
  const bool quick = tasks.is_quick();
  const std::vector<double> parts_of_bound = parts(quick ? 8 : 24);
  std::vector<double> dampings{0};
  for (int i = quick ? 0 : -2; i <= (quick ? 6 : 12); ++i) dampings.push_back(std::pow(10.0, quick ? i : i / 2.0));
  for (const Integrator& integrator : integrators()) {
    if (!allows_damping(integrator, DampingLaw::constant) || (quick && integrator.name != "verlet" && integrator.name != "cv8"))
      continue;
    for (const DampingLaw law : {DampingLaw::constant, DampingLaw::adaptive})
      for (const double damping : allows_damping(integrator, law) ? dampings : std::vector<double>{})
        for (const double part : parts_of_bound) add_cell(tasks, integrator, {1, 40}, law, damping, part);
  }
}

// Adds bodies of other sizes and stiffness.
void add_shapes(StabilityTasks& tasks) {
  for (const char* name : {"verlet", "cv8"})
    for (const int level : {0, 2})
      for (const double stiffness : {0.4, 4000.0})
        for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive})
          for (const double part : parts(tasks.is_quick() ? 8 : 16))
            add_cell(tasks, find_integrator(name), {level, stiffness}, law, law == DampingLaw::none ? 0 : 2000, part);
}

}  // namespace

void add_maps(StabilityTasks& tasks) {
  add_dampings(tasks);
  add_shapes(tasks);
}

}  // namespace pliant::bench
