#include "bench/stability/cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/expect.hpp"
#include "core/thread_pool.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "simulation/measure.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr double growth_limit = 1e-4;  // of amplitude in a step, as in dynamics/stability.hpp
constexpr double growth_in_all = 1e4;  // of energy (an undamped splitting swings 200-fold 0.25 % below its limit)
constexpr double still = 0.01;         // a body with less than this part of the start's energy is at rest
constexpr std::uint64_t judged_stride = 4;
constexpr std::uint64_t window = 1000;
constexpr int growth_samples = 64;
constexpr std::uint64_t growth_stride = 7;
static_assert(2 * growth_samples * growth_stride == steps_of_growth);

CollisionDescription alone() {
  CollisionDescription description;
  description.response = Named{"none"};
  return description;
}

// A body on a device, with its energies.
class Experiment {
 public:
  Experiment(Device& device, const ModelAndState& start, const TimePlan& plan)
      : model_(start.model), simulation_(device, start.model, start.state, plan, alone()) {}

  void advance(std::uint64_t steps) { simulation_.advance(steps); }
  bool is_finite() { return !simulation_.report().breakdown; }
  State state() { return simulation_.state(); }
  StepReport report() { return simulation_.report(); }
  Measurement measured() { return measure(model_, simulation_.state(), glm::dvec3(0.0), pool_); }

  // Returns the largest energy of `samples`, or NaN or infinity if one is not finite.
  double largest_energy(int samples, std::uint64_t stride) {
    double largest = 0;
    for (int k = 0; k < samples; ++k) {
      simulation_.advance(stride);
      const double energy = measured().energy();
      if (!std::isfinite(energy)) return energy;
      largest = std::max(largest, energy);
    }
    return is_finite() ? largest : std::numeric_limits<double>::quiet_NaN();
  }

  // Returns the mean energy over `window` steps, weighted by a sine squared.
  double smooth_energy() {
    double sum = 0;
    for (std::uint64_t k = 1; k <= window; ++k) {
      simulation_.advance(1);
      const double sine = std::sin(std::numbers::pi * static_cast<double>(k) / window);
      sum += sine * sine * measured().energy();
    }
    return sum / (window / 2);
  }

 private:
  const Model& model_;
  ThreadPool pool_{1};
  Simulation simulation_;
};

double energy_of(const ModelAndState& start) {
  ThreadPool alone(1);
  return measure(start.model, start.state, glm::dvec3(0.0), alone).energy();
}

// Returns the next step to try after `part`. Both are parts of the predicted limit. srkn11b's first instability is 0.03 % wide.
double next_probe(double part) {
  if (part < 0.97) return part * 1.03;
  if (part < 1) return 1;
  if (part < 1.0004) return part + 5e-5;
  return part * (part < 1.2 ? 1.02 : 1.15);
}

TimePlan with_step(TimePlan plan, double time_step) {
  plan.time_step = time_step;
  return plan;
}

}  // namespace

ModelBody Sphere::body() const {
  ModelBody body;
  body.vertex_count = vertex_count();
  body.stiffness = stiffness;
  body.damping = damping;
  return body;
}

double Sphere::omega() const { return stiffest_frequency(body()); }

ModelAndState Sphere::build() const {
  BodySetup setup;
  setup.mesh = generate_mesh("icosphere:" + std::to_string(level));
  BodyDescription& description = setup.description;
  description.name = "sphere";
  description.stiffness = stiffness;
  description.damping = damping;
  description.stretch = {1 - squash, 1 + 0.5 * squash, 1 + 0.5 * squash};
  description.position = position;
  description.velocity = velocity;
  description.spin = spin;
  return build_model({&setup, 1}, glm::dvec3(0.0));
}

TimePlan plan_of(const Integrator& integrator, DampingLaw law, double time_step) {
  TimePlan plan;
  plan.integrator = &integrator;
  plan.time_step = time_step;
  plan.damping_law = law;
  return plan;
}

bool grows(Device& device, const ModelAndState& start, const TimePlan& plan) {
  Experiment experiment(device, start, plan);
  const double before = experiment.largest_energy(growth_samples, growth_stride);
  if (!std::isfinite(before)) return true;
  const double after = experiment.largest_energy(growth_samples, growth_stride);
  const double allowed = std::pow(1 + growth_limit, 2.0 * growth_samples * growth_stride), at_start = energy_of(start);
  return !(after <= std::max(allowed * before, 1e-6 * at_start)) || after > growth_in_all * at_start;
}

std::optional<double> find_limit(Device& device, const ModelAndState& start, const TimePlan& plan, double predicted) {
  const auto unstable_at = [&](double time_step) { return grows(device, start, with_step(plan, time_step)); };
  double stable = 0.8 * predicted;
  while (unstable_at(stable)) stable *= 0.8;
  double unstable = stable;
  while (!unstable_at(unstable)) {
    stable = unstable;
    unstable = next_probe(stable / predicted) * predicted;
    if (unstable > 4 * predicted) return {};
  }
  while (unstable - stable > 0.0025 * stable) {
    const double middle = 0.5 * (stable + unstable);
    (unstable_at(middle) ? unstable : stable) = middle;
  }
  return 0.5 * (stable + unstable);
}

Verdict judge(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps) {
  PLIANT_EXPECT(steps >= 4 * judged_stride);
  const double before = energy_of(start);
  Experiment experiment(device, start, plan);
  Measurement last_quarter;  // largest kinetic and elastic energy in it
  double largest = 0, last = 0;
  for (std::uint64_t done = 0; done < steps; done += judged_stride) {
    experiment.advance(judged_stride);
    const Measurement now = experiment.measured();
    last = now.energy();
    if (!std::isfinite(last)) return {Outcome::blown_up, std::numeric_limits<double>::infinity()};
    largest = std::max(largest, last);
    if (4 * done < 3 * steps) continue;
    last_quarter.kinetic = std::max(last_quarter.kinetic, now.kinetic);
    last_quarter.elastic = std::max(last_quarter.elastic, now.elastic);
  }
  if (largest > blow_up_growth * before) return {Outcome::blown_up, last / before};
  if (last_quarter.kinetic > still * before) return {Outcome::stable, last / before};
  return {last_quarter.elastic > still * before ? Outcome::creeping : Outcome::damped, last / before};
}

std::optional<double> first_blow_up(Device& device, const ModelAndState& start, const TimePlan& plan, double predicted,
                                    std::uint64_t steps) {
  for (int percent = 10; percent <= 120; percent += 2) {
    const double time_step = 0.01 * percent * predicted;
    if (judge(device, start, with_step(plan, time_step), steps).outcome == Outcome::blown_up) return time_step;
  }
  return {};
}

double energy_drift(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps) {
  PLIANT_EXPECT(steps >= 2 * window);
  Experiment experiment(device, start, plan);
  const double before = experiment.smooth_energy();
  experiment.advance(steps - 2 * window);
  return experiment.smooth_energy() / before - 1;
}

double predicted_drift(const Integrator& integrator, double omega_step, std::uint64_t steps) {
  if (staged_method(integrator) == nullptr) return 0;
  return std::expm1(2.0 * static_cast<double>(steps - window) * std::log(undamped_amplification(integrator, omega_step)));
}

LongRun run_long(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps) {
  Experiment experiment(device, start, plan);
  const Measurement before = experiment.measured();
  experiment.advance(steps);
  const Measurement after = experiment.measured();
  const double momentum = glm::length(before.angular_momentum);
  return {.end = experiment.state(),
          .energy_change = after.energy() / before.energy() - 1,
          .angular_momentum_change = momentum > 0 ? glm::length(after.angular_momentum - before.angular_momentum) / momentum : 0,
          .frame_changes = experiment.report().frame_changes};
}

ModelAndState nudged(ModelAndState start) {
  for (std::size_t i = 0; i < start.state.motion.size(); ++i)
    if (i % 6 < 3) start.state.motion[i] += i % 4 < 2 ? 1e-12 : -1e-12;
  return start;
}

double mean_distance(const Model& model, const State& a, const State& b) {
  const std::vector<glm::dvec3> p = a.world_positions(model), q = b.world_positions(model);
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += glm::dot(p[i] - q[i], p[i] - q[i]);
  return std::isfinite(sum) ? std::sqrt(sum / static_cast<double>(p.size())) : std::numeric_limits<double>::infinity();
}

}  // namespace pliant::bench
