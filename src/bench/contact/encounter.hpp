// Watches two bodies that meet, from shortly before their first impulse until they have parted.
#pragma once
#include <cstdint>
#include <stop_token>

#include "bench/contact/witness.hpp"

namespace pliant::bench {

/// How many parts of steps an encounter gets.
struct Patience {
  std::uint64_t to_meet = 20000;  // at most
  std::uint64_t closely = 0;      // with proofs for each part
  std::uint64_t to_part = 20000;  // at most, beyond those, with a look now and then
  std::uint64_t stride = 1;       // once in so many of the first ones it looks at motions
};

struct SeenEncounter {
  Seen seen;                      // until bodies have parted; its report counts from where watching began
  std::uint64_t close_steps = 0;  // that were watched closely
  std::uint64_t close_parts = 0;  // parts of those
  bool parted = false;            // the bodies' boxes are apart in the end
};

/// Runs the simulation to its first impulse, goes back some parts, and watches from there. Without gravity.
[[nodiscard]] SeenEncounter watch_encounter(Simulation& simulation, const Model& model, const Patience& patience,
                                            const std::stop_token& stop);

/// Runs as many steps, and returns the largest change of momentum since their start [kg m/s].
[[nodiscard]] double most_change_of_momentum(Simulation& simulation, const Model& model, std::uint64_t steps,
                                             const std::stop_token& stop);

}  // namespace pliant::bench
