#include "bench/steps/trial.hpp"

#include <algorithm>

namespace pliant::bench {
namespace {

constexpr double telling_time = 1;      // [s]; steps that took so long foretell the others
constexpr double longest_batch = 0.25;  // [s], at the pace of the batch before

std::uint64_t next_batch(std::uint64_t made, std::uint64_t left, double step_seconds) {
  const auto most = static_cast<double>(std::min(made + 1, left));
  return static_cast<std::uint64_t>(step_seconds > 0 ? std::clamp(longest_batch / step_seconds, 1.0, most) : most);
}

}  // namespace

Trial try_steps(std::uint64_t steps, double longest, const StepTimer& seconds_of) {
  Trial trial;
  double step_seconds = 0;
  for (std::uint64_t made = 0; made < steps;) {
    const std::uint64_t batch = next_batch(made, steps - made, step_seconds);
    const double seconds = seconds_of(batch);
    step_seconds = seconds / static_cast<double>(batch);
    made += batch;
    trial.seconds += seconds;
    trial.foreseen_seconds = trial.seconds * (static_cast<double>(steps) / static_cast<double>(made));
    if (made < steps && trial.seconds > telling_time && trial.foreseen_seconds > longest) return trial;
  }
  trial.is_complete = true;
  return trial;
}

}  // namespace pliant::bench
