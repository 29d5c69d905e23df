// Steps whose times are formulas, not measured.
#include "bench/steps/trial.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace pliant::bench {
namespace {

// Steps of which the first ones take one time and the others another one [s].
struct Steps {
  double early = 0, late = 0;
  std::uint64_t early_count = 0;
  std::uint64_t made = 0;
  std::vector<double> batches{};  // their times [s]

  Trial attempt(std::uint64_t steps, double longest) {
    return try_steps(steps, longest, [this](std::uint64_t batch) {
      double seconds = 0;
      for (std::uint64_t k = 0; k < batch; ++k) seconds += made++ < early_count ? early : late;
      batches.push_back(seconds);
      return seconds;
    });
  }
};

TEST_CASE("a trial of short steps makes each of them once, in few batches") {
  Steps steps{.late = 1e-5};
  const Trial trial = steps.attempt(1000, 60);
  CHECK(trial.is_complete);
  CHECK(steps.made == 1000);
  CHECK(steps.batches.size() <= 10);
  CHECK(trial.seconds == Approx(0.01));
  CHECK(trial.foreseen_seconds == trial.seconds);
}

TEST_CASE("a trial of a run that takes too long ends after little more than a second, and foretells how long it would take") {
  Steps steps{.late = 0.01};
  const Trial trial = steps.attempt(100'000, 60);
  CHECK_FALSE(trial.is_complete);
  CHECK(trial.seconds <= 1.25 + 1e-9);
  CHECK(trial.foreseen_seconds == Approx(1000));
  Steps slow{.late = 20};
  CHECK_FALSE(slow.attempt(4, 60).is_complete);
  CHECK(slow.made == 1);
}

TEST_CASE("a run that becomes slow is left when it would take too long from what it took") {
  Steps steps{.early = 0.001, .late = 0.5, .early_count = 5000};  // 5 s, then 2500 s
  const Trial trial = steps.attempt(10'000, 60);
  CHECK_FALSE(trial.is_complete);
  CHECK(steps.made > 5000);
  CHECK(trial.foreseen_seconds > 60);
  CHECK(trial.seconds < 200);
}

TEST_CASE("a run that takes no longer than it may is made to its end, however slow its steps are") {
  Steps steps{.late = 14};
  CHECK(steps.attempt(4, 60).is_complete);
  Steps at_the_end{.early = 0.001, .late = 70, .early_count = 9};
  const Trial trial = at_the_end.attempt(10, 60);
  CHECK(trial.is_complete);  // it was too long, but there is nothing left to save
  CHECK(trial.seconds > 70);
}

TEST_CASE("batches of a trial are short enough for it to end in time") {
  Steps steps{.late = 0.001};
  CHECK(steps.attempt(20'000, 60).is_complete);
  for (const double seconds : steps.batches) CHECK(seconds <= 0.25 + 1e-9);
}

TEST_CASE("a trial without steps is complete") { CHECK(Steps{}.attempt(0, 60).is_complete); }

}  // namespace
}  // namespace pliant::bench
