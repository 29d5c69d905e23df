// The suite `stability`: measures how far fp32 strays from fp64. Bodies are far from the world's origin, rotate fast, or have
// different amplitudes and sizes.
#include <cmath>
#include <memory>
#include <numbers>

#include "bench/stability/tasks.hpp"

namespace pliant::bench {
namespace {

constexpr double errors_omega_step = 0.5;  // step times the stiffest mode's frequency

// Returns the places with the reference first, even if it was not asked for.
std::vector<Place> places_of_errors(const StabilityTasks& tasks) {
  std::vector<Place> places = tasks.places();
  std::erase_if(places, [](const Place& place) { return place.precision == 64; });
  places.insert(places.begin(), {.device = DeviceKind::cpu, .precision = 64});
  return places;
}

std::optional<double> error_of(Device& device, const ErrorRow& row, const ModelAndState& start, const TimePlan& plan,
                               const State& end, const State& reference) {
  const bool tumbles = row.turns > 0;
  if (device.precision() == 32) return mean_distance(start.model, end, reference) / (tumbles ? 1 : row.amplitude);
  if (!tumbles) return {};
  return mean_distance(start.model, end, run_long(device, nudged(start), plan, row.steps).end);
}

ErrorRow with_findings(ErrorRow row, const Place& place, const LongRun& found, std::optional<double> error) {
  row.device = place.device;
  row.precision = place.precision;
  row.error = error;
  row.energy_change = found.energy_change;
  row.angular_momentum_change = row.turns > 0 ? found.angular_momentum_change : 0;
  row.frame_changes = found.frame_changes;
  return row;
}

// `row` has all values except the measured ones. The reference runs once for all places.
void add_rows(StabilityTasks& tasks, ErrorRow row, const Integrator& integrator, const Sphere& body) {
  const auto start = std::make_shared<const ModelAndState>(body.build());
  const TimePlan plan = plan_of(integrator, DampingLaw::none, errors_omega_step / body.omega());
  row.integrator = integrator.name;
  row.vertices = body.vertex_count();
  row.amplitude = body.squash;
  const auto reference = std::make_shared<State>();
  for (const Place& place : places_of_errors(tasks))
    tasks.add(row.family, integrator, place, row.vertices, static_cast<double>(row.steps), [=](Device& device) {
      const LongRun found = run_long(device, *start, plan, row.steps);
      if (place.precision == 64) *reference = found.end;
      return with_findings(row, place, found, error_of(device, row, *start, plan, found.end, *reference));
    });
}

void add_far(StabilityTasks& tasks) {
  for (const double distance : {0.0, 100.0, 1e4})
    add_rows(tasks, {.family = "far", .distance = distance, .steps = 200}, find_integrator("cv8"),
             {.level = tasks.is_quick() ? 1 : 3,
              .squash = 0.2,
              .position = {distance, -0.6 * distance, 0.3 * distance},
              .velocity = {5, 1, 0},
              .spin = {0, 2, 1}});
}

void add_amplitudes(StabilityTasks& tasks) {
  for (const double amplitude : {1e-4, 1e-3, 1e-2, 0.1, 0.2, 0.5})
    add_rows(tasks, {.family = "amplitude", .steps = 200}, find_integrator("cv8"),
             {.level = tasks.is_quick() ? 1 : 3, .squash = amplitude});
}

void add_sizes(StabilityTasks& tasks) {
  for (int level = 0; level <= (tasks.is_quick() ? 3 : 5); ++level)
    add_rows(tasks, {.family = "size", .steps = 400}, find_integrator("verlet"), {.level = level, .squash = 0.2});
}

// The body turns about as fast as it bears: centrifugal forces make it 4 % larger.
void add_tumble(StabilityTasks& tasks, int level, double turns) {
  constexpr double omega_spin = 0.2;
  Sphere body{.level = level, .squash = 0.02};
  body.spin = omega_spin * body.omega() * glm::normalize(glm::dvec3(1, 2, 3));
  const double steps = std::ceil(turns * 2 * std::numbers::pi / (omega_spin * errors_omega_step));
  add_rows(tasks, {.family = "tumble", .turns = turns, .steps = static_cast<std::uint64_t>(steps)}, find_integrator("cv8"), body);
}

void add_tumbling(StabilityTasks& tasks) {
  for (const double turns : {10.0, 100.0, 1000.0}) add_tumble(tasks, 1, turns);
  if (!tasks.is_quick()) add_tumble(tasks, 3, 100);
}

}  // namespace

void add_errors(StabilityTasks& tasks) {
  add_far(tasks);
  add_amplitudes(tasks);
  add_sizes(tasks);
  add_tumbling(tasks);
}

}  // namespace pliant::bench
