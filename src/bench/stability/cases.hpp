// One measurement each of the suite `stability`: a limit, a cell of the map, a drift, an error.
#pragma once
#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "simulation/time_plan.hpp"

namespace pliant::bench {

/// An icosphere of radius 1 m with m = 1 kg.
struct Sphere {
  int level = 1;
  double stiffness = 40;     // k [N/m]
  double damping = 0;        // c [kg/s]
  double squash = 0;         // shorter by this part along x, longer by half of it along y and z
  glm::dvec3 position{0.0};  // [m]
  glm::dvec3 velocity{0.0};  // [m/s]
  glm::dvec3 spin{0.0};      // [rad/s]

  [[nodiscard]] std::uint32_t vertex_count() const { return 10u * (1u << (2 * level)) + 2; }
  [[nodiscard]] ModelBody body() const;  // its material, for bounds
  /// The stiffest mode's angular frequency, sqrt(N k / m) [rad/s].
  [[nodiscard]] double omega() const;
  [[nodiscard]] ModelAndState build() const;
};

[[nodiscard]] TimePlan plan_of(const Integrator& integrator, DampingLaw law, double time_step /* [s] */);

inline constexpr std::uint64_t steps_of_growth = 896;

/// Within so many steps, whether motion grows by more than 1e-4 a step: the largest energy of 64 samples, seven steps apart,
/// against that of the 64 before; or 1e4-fold in all: a Runge-Kutta method just beyond its limit ends in steady wild motion, the
/// body turning inside out. What has died down to a millionth of the start's energy does not count. Expects a start of small
/// amplitude.
[[nodiscard]] bool grows(Device& device, const ModelAndState& start, const TimePlan& plan);

/// The shortest step at which the motion grows, to 0.25 %, searched outward from below `predicted` [s], and finely just beyond
/// it; empty when four times `predicted` is stable, too. `plan`'s own step does not matter.
[[nodiscard]] std::optional<double> find_limit(Device& device, const ModelAndState& start, const TimePlan& plan,
                                               double predicted);

enum class Outcome {
  stable,    // the rest: moves on
  damped,    // at rest in its own shape: kinetic and elastic energy stayed below a hundredth of the start's energy in the last
             // quarter
  creeping,  // kinetic energy did: so damped that it is not back in its shape yet
  blown_up,  // a vertex was not finite at some time, or the energy above blow_up_growth times the start's
};

struct Verdict {
  Outcome outcome = Outcome::stable;
  double energy_ratio = 0;  // the end's energy over the start's; infinite where a vertex is not finite
};

/// Over so many steps, looked at every four: at least 16.
[[nodiscard]] Verdict judge(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// The shortest step that blows up within `steps` steps, of those every 2 % of `predicted` [s] from 0.1 to 1.2 of it; empty where
/// none does. `plan`'s own step does not matter.
[[nodiscard]] std::optional<double> first_blow_up(Device& device, const ModelAndState& start, const TimePlan& plan,
                                                  double predicted, std::uint64_t steps);

/// Relative change of the energy between the first and the last thousand steps, each averaged so smoothly that the oscillation
/// of a symplectic method's energy cancels. Expects 2000 steps or more.
[[nodiscard]] double energy_drift(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// The same of exact arithmetic, for a breathing body: |R(i omega h)|^2 a step for a Runge-Kutta method, nothing for a splitting.
[[nodiscard]] double predicted_drift(const Integrator& integrator, double omega_step, std::uint64_t steps);

struct LongRun {
  State end;
  double energy_change = 0;            // relative to the start's
  double angular_momentum_change = 0;  // relative to the start's, about the world's origin; 0 where that is 0
  std::uint64_t frame_changes = 0;
};

[[nodiscard]] LongRun run_long(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// The same start with every coordinate 1e-12 m larger or smaller: what becomes of that shows how well determined an end is.
[[nodiscard]] ModelAndState nudged(ModelAndState start);

/// Root mean square over vertices of the distance between the states' world positions [m]; infinite where one is not finite.
[[nodiscard]] double mean_distance(const Model& model, const State& a, const State& b);

}  // namespace pliant::bench
