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
  std::size_t touching = 0;            // pairs of triangles that were not apart, in all states and on the ways between them
  std::size_t inside = 0;              // vertices that were inside another body, in all states
  double momentum_change = 0;          // the largest, over the sum of m |v| at the start
  double angular_momentum_change = 0;  // of the latest state, over the sum of |x x m v| at the start
  double most_energy = 0;              // the largest above the start's, over the start's kinetic energy; at least 0
  double last_energy = 0;              // the latest one, in the same way
  StepReport report;
};

/// Without gravity.
class Witness {
 public:
  /// `start` must outlive the witness.
  explicit Witness(const ModelAndState& start);

  /// Proves that bodies are apart in this state, and at seven times on the straight way from the one before.
  void look_at_places(const State& state);
  /// Measures momentum and energy, and looks for vertices inside other bodies. This takes longer.
  void look_at_motion(const State& state);

  Seen seen;

 private:
  const ModelAndState& start_;
  ApartOracle oracle_;
  ThreadPool pool_{1};
  Measurement first_;
  glm::dvec3 first_momentum_;
  double sum_of_momenta_ = 0, sum_of_angular_momenta_ = 0;
  std::vector<glm::dvec3> before_;
};

/// How long to watch, and how closely.
struct Watch {
  std::uint64_t steps = 0;
  std::uint64_t most_parts = UINT64_MAX;  // of steps; they end the watch, too
  std::uint64_t stride = 1;               // once in so many parts it looks at motions
  std::stop_token stop = {};              // ends the watch early
};

/// Runs the simulation and looks at every part of a step.
[[nodiscard]] Seen watch(Simulation& simulation, const ModelAndState& start, const Watch& how);

/// Does the same with a tolerance, for `duration` [s], and looks at every try of a step.
[[nodiscard]] Seen watch_for(Simulation& simulation, const ModelAndState& start, double duration);

}  // namespace pliant::bench
