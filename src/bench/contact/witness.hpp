// Sees the states of a run with contact, and says what must hold: bodies are apart, and momentum and energy are kept.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <stop_token>
#include <vector>

#include "bench/contact/apart.hpp"
#include "core/thread_pool.hpp"
#include "simulation/measure.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {

struct Seen {
  std::size_t touching = 0;            // pairs of triangles that were not apart, in states and on ways between them
  std::size_t inside = 0;              // vertices that were inside another body, in all states
  double momentum_change = 0;          // the largest, over the sum of m |v| at the start
  double angular_momentum_change = 0;  // of the latest state, over the sum of |x x m v| at the start
  double most_energy = 0;              // the largest above the start's, over the start's kinetic energy; at least 0
  double last_energy = 0;              // the latest one, in the same way
  State most_deformed;                 // of those whose motion was looked at
  StepReport report;
};

/// Returns the momentum of bodies that are not static [kg m/s].
[[nodiscard]] glm::dvec3 momentum_of(const Model& model, const State& state);
/// Returns the sum of m |v| over their vertices [kg m/s].
[[nodiscard]] double sum_of_momenta(const Model& model, const State& state);

/// Without gravity.
class Witness {
 public:
  /// `start` must outlive the witness.
  explicit Witness(const ModelAndState& start);

  /// Measures momentum. Proves that bodies are apart in this state, and at seven times on the straight way from the one before.
  void look_at_places(const State& state);
  /// Does the same in this state alone.
  void look_at_place(const State& state);
  /// Measures energy and angular momentum, and looks for vertices inside other bodies. This takes longer.
  void look_at_motion(const State& state);

  /// Returns whether the bodies' boxes are apart.
  [[nodiscard]] bool have_parted(const State& state) const;

  Seen seen;

 private:
  void look_at_momentum(const State& state);

  const ModelAndState& start_;
  ApartOracle oracle_;
  ThreadPool pool_{1};
  Measurement first_;
  glm::dvec3 first_momentum_;
  double sum_of_momenta_ = 0, sum_of_angular_momenta_ = 0;
  double most_elastic_ = -1;  // of the most deformed state [J]
  std::vector<glm::dvec3> before_;
};

/// How long to watch, and how closely.
struct Watch {
  std::uint64_t steps = UINT64_MAX;       // since the simulation's own start
  std::uint64_t most_parts = UINT64_MAX;  // of steps; they end the watch, too
  std::uint64_t stride = 1;               // once in so many parts it looks at motions
  std::stop_token stop = {};              // ends the watch early
};

/// Runs the simulation and looks at every part of a step.
void watch(Simulation& simulation, Witness& witness, const Watch& how);
[[nodiscard]] Seen watch(Simulation& simulation, const ModelAndState& start, const Watch& how);

/// Does the same with a tolerance, for `duration` [s], and looks at every try of a step.
[[nodiscard]] Seen watch_for(Simulation& simulation, const ModelAndState& start, double duration);

}  // namespace pliant::bench
