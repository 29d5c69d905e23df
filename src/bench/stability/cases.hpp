// Makes single measurements of the suite `stability`: a limit, a cell of the map, a drift or an error.
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

/// Returns whether motion grows within steps_of_growth steps: by more than 1e-4 a step in amplitude, or 1e4-fold in energy.
/// Growth a step compares the largest energy of 64 samples, seven steps apart, with that of the 64 samples before. Growth in all
/// counts, too, because a Runge-Kutta method just beyond its limit ends in steady wild motion, in which the body turns inside
/// out. Motion below a millionth of the start's energy does not count. Expects a start of small amplitude.
[[nodiscard]] bool grows(Device& device, const ModelAndState& start, const TimePlan& plan);

/// Returns the shortest step at which the motion grows [s], to 0.25 %, or nothing if four times `predicted` [s] is stable, too.
/// Finds a stable step below `predicted` and searches upward from there, finely just beyond it. `plan`'s own step does not
/// matter.
[[nodiscard]] std::optional<double> find_limit(Device& device, const ModelAndState& start, const TimePlan& plan,
                                               double predicted);

enum class Outcome {
  /// None of the others: it still moves.
  stable,
  /// It is at rest in its own shape. In the last quarter kinetic and elastic energy stayed below a hundredth of the start's
  /// energy.
  damped,
  /// Only its kinetic energy stayed that low. It is so damped that it is not back in its shape yet.
  creeping,
  /// A vertex became non-finite, or the energy exceeded blow_up_growth times the start's.
  blown_up,
};

struct Verdict {
  Outcome outcome = Outcome::stable;
  double energy_ratio = 0;  // the end's energy over the start's; infinite if a vertex is not finite
};

/// Judges a run of `steps` steps, and looks at it every four steps. Expects 16 steps or more.
[[nodiscard]] Verdict judge(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// Returns the shortest step that blows up within `steps` steps [s], or nothing if none does. Tries steps from 0.1 to 1.2 of
/// `predicted` [s], 2 % of it apart. `plan`'s own step does not matter.
[[nodiscard]] std::optional<double> first_blow_up(Device& device, const ModelAndState& start, const TimePlan& plan,
                                                  double predicted, std::uint64_t steps);

/// Returns the relative change of the energy between the first and the last thousand steps. The means over both are so smooth
/// that the oscillation of a symplectic method's energy cancels. Expects 2000 steps or more.
[[nodiscard]] double energy_drift(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// Returns the same for a breathing body in exact arithmetic. A step multiplies the energy by |R(i omega h)|^2 for a Runge-Kutta
/// method. For a splitting the result is 0.
[[nodiscard]] double predicted_drift(const Integrator& integrator, double omega_step, std::uint64_t steps);

struct LongRun {
  State end;
  double energy_change = 0;            // relative to the start's
  double angular_momentum_change = 0;  // relative to the start's, about the world's origin; 0 if that is 0
  std::uint64_t frame_changes = 0;
};

[[nodiscard]] LongRun run_long(Device& device, const ModelAndState& start, const TimePlan& plan, std::uint64_t steps);

/// Returns the start with every coordinate 1e-12 m larger or smaller. A run from there shows how well determined an end is.
[[nodiscard]] ModelAndState nudged(ModelAndState start);

/// Returns the root mean square over vertices of the distance between the states' world positions [m]. It is infinite if a
/// position is not finite.
[[nodiscard]] double mean_distance(const Model& model, const State& a, const State& b);

}  // namespace pliant::bench
