// Finds out whether a run is short enough to be measured, by making its steps until that is known. Nothing is assumed of what a
// step costs: springs, contacts and bodies that sleep all count as they come.
#pragma once
#include <cstdint>
#include <functional>

namespace pliant::bench {

struct Trial {
  bool is_complete = false;     // all steps were made
  double seconds = 0;           // that the steps made took
  double foreseen_seconds = 0;  // of all steps, by the mean of those made
};

/// Makes so many steps and returns their time [s].
using StepTimer = std::function<double(std::uint64_t steps)>;

/// Makes steps in growing batches, up to a quarter of a second each. After a second it ends as soon as all steps would take
/// longer than `longest` [s] at this pace.
[[nodiscard]] Trial try_steps(std::uint64_t steps, double longest, const StepTimer& seconds_of);

}  // namespace pliant::bench
