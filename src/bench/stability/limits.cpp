// The suite `stability`: measures how long a step may be, and what long runs do to the energy.
#include "bench/stability/tasks.hpp"
#include "dynamics/stability.hpp"
#include "model/deform.hpp"

namespace pliant::bench {
namespace {

void add_limit(StabilityTasks& tasks, const Integrator& integrator, const Place& place, const Sphere& body, double damping) {
  tasks.add("limits", integrator, place, body.vertex_count(), 12'000, [=, &integrator](Device& device) {
    Sphere damped = body;
    damped.damping = damping;
    damped.velocity.x = damping > 0 ? 1 : 0;  // damping may bound the body's own drift more than its springs do
    ModelAndState start = damped.build();
    swell(start.model, start.state, small_amplitude);
    const DampingLaw law = damping > 0 ? DampingLaw::constant : DampingLaw::none;
    const double predicted = step_bound(integrator, damped.body(), law);
    const TimePlan plan = plan_of(integrator, law, predicted);
    return LimitRow{std::string(integrator.name),
                    place.device,
                    place.precision,
                    body.vertex_count(),
                    body.stiffness,
                    damping,
                    small_amplitude,
                    steps_of_growth,
                    predicted,
                    find_limit(device, start, plan, predicted)};
  });
}

void add_small_limits(StabilityTasks& tasks) {
  std::vector<Sphere> bodies = {{1, 40}};
  if (!tasks.is_quick()) bodies = {{0, 1}, {0, 40}, {0, 1000}, {1, 1}, {1, 40}, {1, 1000}, {2, 1}, {2, 40}, {2, 1000}};
  for (const Integrator& integrator : integrators())
    for (const Place& place : tasks.places())
      for (const Sphere& body : bodies) add_limit(tasks, integrator, place, body, 0);
  const Sphere body{1, 40};
  for (const char* name : {"verlet", "cv8", "dop853", "dprkn8", "dprkn12"})
    for (const double rate : {0.5, 2.0, 8.0})  // damping rate over omega
      add_limit(tasks, find_integrator(name), tasks.places().front(), body, rate * body.omega());
}

void add_large_limit(StabilityTasks& tasks, const Integrator& integrator, const Place& place, double amplitude) {
  const Sphere body{.squash = amplitude};
  const std::uint64_t steps = tasks.is_quick() ? 2'000 : 20'000;
  tasks.add("limits", integrator, place, body.vertex_count(), 40.0 * static_cast<double>(steps),
            [=, &integrator](Device& device) {
              const double predicted = step_bound(integrator, body.body(), DampingLaw::none);
              const TimePlan plan = plan_of(integrator, DampingLaw::none, predicted);
              return LimitRow{std::string(integrator.name),
                              place.device,
                              place.precision,
                              body.vertex_count(),
                              body.stiffness,
                              0,
                              amplitude,
                              steps,
                              predicted,
                              first_blow_up(device, body.build(), plan, predicted, steps)};
            });
}

// Large motion is not linear. A method with longer steps loses a larger part of its bound to that.
void add_large_limits(StabilityTasks& tasks) {
  const std::vector<double> amplitudes = tasks.is_quick() ? std::vector{0.5} : std::vector{0.1, 0.2, 0.5};
  for (const Integrator& integrator : integrators())
    for (const double amplitude : amplitudes) add_large_limit(tasks, integrator, tasks.places().front(), amplitude);
}

}  // namespace

void add_limits(StabilityTasks& tasks) {
  add_small_limits(tasks);
  add_large_limits(tasks);
}

void add_drifts(StabilityTasks& tasks) {
  constexpr double omega_step = 0.5;
  constexpr std::uint64_t steps = 100'000;
  const Sphere body{0, 40};
  for (const Integrator& integrator : integrators()) {
    if (tasks.is_quick() && integrator.name != "verlet" && integrator.name != "cv8") continue;
    for (const Place& place : tasks.places())
      tasks.add("energy", integrator, place, body.vertex_count(), steps, [=, &integrator](Device& device) {
        ModelAndState start = body.build();
        swell(start.model, start.state, 0.01);
        const TimePlan plan = plan_of(integrator, DampingLaw::none, omega_step / body.omega());
        return DriftRow{std::string(integrator.name),
                        place.device,
                        place.precision,
                        body.vertex_count(),
                        omega_step,
                        steps,
                        energy_drift(device, start, plan, steps),
                        predicted_drift(integrator, omega_step, steps)};
      });
  }
}

}  // namespace pliant::bench
