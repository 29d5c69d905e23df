// A list of tasks, each of which measures one row; then notes on what they come to.
#include "bench/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

#include "dynamics/stability.hpp"

namespace pliant::bench {
namespace {

constexpr double errors_omega_step = 0.5;  // step times the stiffest mode's frequency
constexpr double small_amplitude = 1e-3;
constexpr double agreement = 0.02;  // of measured limits with predicted ones

// One for each device and precision, opened when first needed. Small bodies are fastest on one thread of the CPU.
class Devices {
 public:
  explicit Devices(const Selection& selection) : selection_(selection) {}

  Device& at(const Place& place, std::uint32_t vertices) {
    Place sized = place;
    sized.threads = vertices < 300 ? 1 : selection_.threads;
    std::unique_ptr<Device>& device = open_[name_of(sized)];
    if (!device) device = open(sized);
    return *device;
  }

  // fp64 and fp32 on the CPU, then the GPU.
  std::vector<Place> all() const {
    std::vector<Place> places;
    if (selection_.cpu) places = {{.device = "cpu", .precision = 64}, {.device = "cpu", .precision = 32}};
    if (selection_.gpu) places.push_back({.device = "gpu", .precision = 32, .gpu_index = selection_.gpu_index});
    return places;
  }

 private:
  Selection selection_;
  std::map<std::string, std::unique_ptr<Device>> open_;
};

std::string name_of(DampingLaw law) {
  return law == DampingLaw::none ? "none" : law == DampingLaw::constant ? "constant" : "adaptive";
}

// As the automatic step has it: the stiffest mode, and the body's own translation.
double bound_of(const Integrator& integrator, double omega, double damping_rate) {
  return std::min(step_bound(integrator, omega * omega, damping_rate), step_bound(integrator, 0, damping_rate));
}

struct Task {
  std::string name;
  double cost = 0;  // in units that all tasks share
  std::function<StabilityRow()> measure;
};

double cost_of(const Integrator& integrator, std::uint32_t vertices, double steps) {
  return steps * evaluations_per_step(integrator) * (0.5 * vertices * vertices + 500);
}

class Plan {
 public:
  Plan(const StabilityOptions& options, Devices& devices) : quick_(options.quick), devices_(devices) {}

  std::vector<Task> tasks() && {
    add_limits();
    add_large_limits();
    add_map();
    add_shapes();
    add_drifts();
    add_far();
    add_amplitudes();
    add_sizes();
    add_tumbling();
    return std::move(tasks_);
  }

 private:
  void add(const std::string& what, const Integrator& integrator, const Place& place, std::uint32_t vertices, double steps,
           std::function<StabilityRow(Device&)> measure) {
    tasks_.push_back({fmt::format("{}, {}, {} {}", what, integrator.name, place.device, place.precision),
                      cost_of(integrator, vertices, steps),
                      [=, &devices = devices_] { return measure(devices.at(place, vertices)); }});
  }

  void add_limit(const Integrator& integrator, const Place& place, const Sphere& body, double damping) {
    add("limits", integrator, place, body.vertex_count(), 12'000, [=, &integrator](Device& device) {
      const double predicted = bound_of(integrator, body.omega(), damping);
      Sphere damped = body;
      damped.damping = damping;
      damped.velocity.x = damping > 0 ? 1 : 0;  // damping may bound the body's own drift more than its springs do
      ModelAndState start = damped.build();
      breathe(start, small_amplitude);
      const TimePlan plan = plan_of(integrator, damping > 0 ? DampingLaw::constant : DampingLaw::none, predicted);
      return LimitRow{std::string(integrator.name),
                      place.device,
                      place.precision,
                      body.vertex_count(),
                      body.stiffness,
                      damping,
                      small_amplitude,
                      predicted,
                      find_limit(device, start, plan, predicted)};
    });
  }

  void add_limits() {
    std::vector<Sphere> bodies = {{1, 40}};
    if (!quick_) bodies = {{0, 1}, {0, 40}, {0, 1000}, {1, 1}, {1, 40}, {1, 1000}, {2, 1}, {2, 40}, {2, 1000}};
    for (const Integrator& integrator : integrators())
      for (const Place& place : devices_.all())
        for (const Sphere& body : bodies) add_limit(integrator, place, body, 0);
    const Sphere body{1, 40};
    for (const char* name : {"verlet", "cv8", "dop853"})
      for (const double rate : {0.5, 2.0, 8.0})  // over omega
        add_limit(find_integrator(name), devices_.all().front(), body, rate * body.omega());
  }

  void add_large_limit(const Integrator& integrator, const Place& place, double amplitude) {
    const Sphere body{.squash = amplitude};
    add("limits", integrator, place, body.vertex_count(), 16'000, [=, &integrator](Device& device) {
      const double predicted = bound_of(integrator, body.omega(), 0);
      const TimePlan plan = plan_of(integrator, DampingLaw::none, predicted);
      return LimitRow{std::string(integrator.name),
                      place.device,
                      place.precision,
                      body.vertex_count(),
                      body.stiffness,
                      0,
                      amplitude,
                      predicted,
                      first_blow_up(device, body.build(), plan, predicted)};
    });
  }

  // Large motion is not linear: the longer a step is against a period, the more of its bound that costs.
  void add_large_limits() {
    const std::vector<double> amplitudes = quick_ ? std::vector{0.5} : std::vector{0.1, 0.2, 0.5};
    for (const Integrator& integrator : integrators())
      for (const double amplitude : amplitudes) add_large_limit(integrator, devices_.all().front(), amplitude);
  }

  void add_cell(const Integrator& integrator, const Sphere& shape, DampingLaw law, double damping, double part) {
    Sphere body = shape;
    body.damping = damping;
    body.squash = 0.2;
    body.velocity = {1, 0, 0};
    constexpr std::uint64_t steps = 400;
    const Place place = devices_.all()[devices_.all().size() > 1 ? 1 : 0];  // fp32 on the CPU, where it is asked for
    add("map", integrator, place, body.vertex_count(), steps, [=, &integrator](Device& device) {
      const double omega = body.omega(), undamped = bound_of(integrator, omega, 0);
      const double rate = law == DampingLaw::none ? 0 : law == DampingLaw::adaptive ? 10 * damping : damping;
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
                    bound_of(integrator, omega, rate),
                    steps,
                    verdict.outcome,
                    verdict.energy_ratio};
    });
  }

  // The middles of `count` intervals from 0.1 to 4 of the undamped bound; with a multiple of 8 it lies between two of them.
  static std::vector<double> parts(int count) {
    std::vector<double> all;
    for (int i = 0; i < count; ++i) all.push_back(0.1 * std::pow(40.0, (i + 0.5) / count));
    return all;
  }

  void add_map() {
    const std::vector<double> parts_of_bound = parts(quick_ ? 8 : 24);
    std::vector<double> dampings{0};
    for (int i = quick_ ? 0 : -2; i <= (quick_ ? 6 : 12); ++i) dampings.push_back(std::pow(10.0, quick_ ? i : i / 2.0));
    for (const Integrator& integrator : integrators()) {
      if (!allows_damping(integrator) || (quick_ && integrator.name != "verlet" && integrator.name != "cv8")) continue;
      for (const DampingLaw law : {DampingLaw::constant, DampingLaw::adaptive})
        for (const double damping : dampings)
          for (const double part : parts_of_bound) add_cell(integrator, {1, 40}, law, damping, part);
    }
  }

  // Bodies of other sizes and stiffness.
  void add_shapes() {
    for (const char* name : {"verlet", "cv8"})
      for (const int level : {0, 2})
        for (const double stiffness : {0.4, 4000.0})
          for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive})
            for (const double part : parts(quick_ ? 8 : 16))
              add_cell(find_integrator(name), {level, stiffness}, law, law == DampingLaw::none ? 0 : 2000, part);
  }

  void add_drifts() {
    constexpr double omega_step = 0.5;
    constexpr std::uint64_t steps = 100'000;
    const Sphere body{0, 40};
    for (const Integrator& integrator : integrators()) {
      if (quick_ && integrator.name != "verlet" && integrator.name != "cv8") continue;
      for (const Place& place : devices_.all())
        add("energy", integrator, place, body.vertex_count(), steps, [=, &integrator](Device& device) {
          ModelAndState start = body.build();
          breathe(start, 0.01);
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

  // `row` has all but what is measured. The reference runs once for all places.
  void add_errors(ErrorRow row, const Integrator& integrator, const Sphere& body) {
    const auto start = std::make_shared<const ModelAndState>(body.build());
    const TimePlan plan = plan_of(integrator, DampingLaw::none, errors_omega_step / body.omega());
    row.integrator = integrator.name;
    row.vertices = body.vertex_count();
    row.amplitude = body.squash;
    const auto reference = std::make_shared<State>();
    for (const Place& place : places_of_errors())
      add(row.family, integrator, place, row.vertices, static_cast<double>(row.steps), [=](Device& device) {
        const LongRun found = run_long(device, *start, plan, row.steps);
        if (place.precision == 64) *reference = found.end;
        return with_findings(row, place, found, error_of(device, row, *start, plan, found.end, *reference));
      });
  }

  // The reference comes first, asked for or not.
  std::vector<Place> places_of_errors() const {
    std::vector<Place> places = devices_.all();
    std::erase_if(places, [](const Place& place) { return place.precision == 64; });
    places.insert(places.begin(), {.device = "cpu", .precision = 64});
    return places;
  }

  static std::optional<double> error_of(Device& device, const ErrorRow& row, const ModelAndState& start, const TimePlan& plan,
                                        const State& end, const State& reference) {
    const bool tumbles = row.turns > 0;
    if (device.precision() == 32) return mean_distance(start.model, end, reference) / (tumbles ? 1 : row.amplitude);
    if (!tumbles) return {};
    return mean_distance(start.model, end, run_long(device, nudged(start), plan, row.steps).end);
  }

  static ErrorRow with_findings(ErrorRow row, const Place& place, const LongRun& found, std::optional<double> error) {
    row.device = place.device;
    row.precision = place.precision;
    row.error = error;
    row.energy_change = found.energy_change;
    row.angular_momentum_change = row.turns > 0 ? found.angular_momentum_change : 0;
    row.frame_changes = found.frame_changes;
    return row;
  }

  void add_far() {
    for (const double distance : {0.0, 100.0, 1e4})
      add_errors({.family = "far", .distance = distance, .steps = 200}, find_integrator("cv8"),
                 {.level = quick_ ? 1 : 3,
                  .squash = 0.2,
                  .position = {distance, -0.6 * distance, 0.3 * distance},
                  .velocity = {5, 1, 0},
                  .spin = {0, 2, 1}});
  }

  void add_amplitudes() {
    for (const double amplitude : {1e-4, 1e-3, 1e-2, 0.1, 0.2, 0.5})
      add_errors({.family = "amplitude", .steps = 200}, find_integrator("cv8"), {.level = quick_ ? 1 : 3, .squash = amplitude});
  }

  void add_sizes() {
    for (int level = 0; level <= (quick_ ? 3 : 5); ++level)
      add_errors({.family = "size", .steps = 400}, find_integrator("verlet"), {.level = level, .squash = 0.2});
  }

  void add_tumbling() {
    for (const double turns : {10.0, 100.0, 1000.0}) add_tumble(1, turns);
    if (!quick_) add_tumble(3, 100);
  }

  // As fast as a body bears: centrifugal forces make it 4 % larger.
  void add_tumble(int level, double turns) {
    constexpr double omega_spin = 0.2;
    Sphere body{.level = level, .squash = 0.02};
    body.spin = omega_spin * body.omega() * glm::normalize(glm::dvec3(1, 2, 3));
    const double steps = std::ceil(turns * 2 * std::numbers::pi / (omega_spin * errors_omega_step));
    add_errors({.family = "tumble", .turns = turns, .steps = static_cast<std::uint64_t>(steps)}, find_integrator("cv8"), body);
  }

  bool quick_;
  Devices& devices_;
  std::vector<Task> tasks_;
};

template <class Row>
std::vector<Row> rows_of(const StabilityResult& result) {
  std::vector<Row> rows;
  for (const StabilityRow& row : result.rows)
    if (const auto* found = std::get_if<Row>(&row)) rows.push_back(*found);
  return rows;
}

bool is_small_and_undamped(const LimitRow& row) { return row.damping == 0 && row.amplitude == small_amplitude; }

std::string limits_note(const std::vector<LimitRow>& rows) {
  double worst = 0;
  std::size_t count = 0;
  for (const LimitRow& row : rows)
    if (is_small_and_undamped(row) && row.measured_step) {
      worst = std::max(worst, std::abs(*row.measured_step / row.predicted_step - 1));
      ++count;
    }
  return fmt::format("undamped limits at small amplitude: {} measured, the farthest {:.2f} % from the predicted one", count,
                     100 * worst);
}

std::string map_note(const std::vector<MapRow>& rows) {
  std::size_t within = 0, failed = 0, beyond = 0, survived = 0;
  for (const MapRow& row : rows) {
    const bool is_within = row.time_step <= row.predicted_bound;
    const bool blew_up = row.outcome == Outcome::blown_up;
    within += is_within;
    failed += is_within && blew_up;
    beyond += !is_within;
    survived += !is_within && !blew_up;
  }
  return fmt::format("map: of {} cells within the predicted bound {} blew up; of {} beyond it {} did not", within, failed, beyond,
                     survived);
}

std::vector<std::string> notes_of(const StabilityResult& result) {
  std::vector<std::string> notes;
  if (const auto rows = rows_of<LimitRow>(result); !rows.empty()) {
    notes.push_back(limits_note(rows));
    for (const LimitRow& row : rows)
      if (is_small_and_undamped(row) && (!row.measured_step || std::abs(*row.measured_step / row.predicted_step - 1) > agreement))
        notes.push_back(fmt::format("{}, {} vertices, fp{}: the limits differ by more than 2 %", row.integrator, row.vertices,
                                    row.precision));
  }
  if (const auto rows = rows_of<MapRow>(result); !rows.empty()) notes.push_back(map_note(rows));
  return notes;
}

}  // namespace

StabilityResult bench_stability(const StabilityOptions& options, const Progress& progress) {
  Devices devices(options.devices);
  const std::vector<Task> tasks = Plan(options, devices).tasks();
  double total = 0, done = 0;
  for (const Task& task : tasks) total += task.cost;
  StabilityResult result;
  for (const Task& task : tasks) {
    result.interrupted = !progress(done / total, task.name);
    if (result.interrupted) break;
    result.rows.push_back(task.measure());
    done += task.cost;
  }
  if (!result.interrupted) progress(1, "");
  result.notes = notes_of(result);
  return result;
}

}  // namespace pliant::bench
