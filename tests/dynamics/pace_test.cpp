// The controller of adaptive steps by itself: physics/pace.glsl.
#include "physics/pace.glsl"

#include <bit>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

namespace pliant {
namespace {

using physics::Pace;

Pace pace_with(double tolerance) {
  Pace pace{};
  pace.target = 1e9;
  pace.tolerance = tolerance;
  pace.allowed = pace.first_step = 0.01;
  pace.largest_step = 1;
  pace.estimate_order = 8;
  physics::start_anew(pace, 0);
  return pace;
}

// Judges a step as if the method's estimate were this.
void judge_with(Pace& pace, double taken, float estimate) {
  pace.estimate[0] = std::bit_cast<std::uint32_t>(estimate);
  physics::judge(pace, taken);
}

}  // namespace

TEST_CASE("fitted steps end at the target exactly, never pass it and leave no sliver") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-3, 3);
  for (int run = 0; run < 200; ++run) {
    const double allowed = std::pow(10, exponent(random)), total = std::pow(10, exponent(random));
    Pace pace = pace_with(1e-6);
    pace.target = total;
    pace.largest_step = allowed;
    pace.allowed = allowed;
    CAPTURE(allowed, total);
    double shortest = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 2000 && pace.time < total; ++step) {
      const double taken = physics::next_step(pace, 0);
      REQUIRE(taken > 0);
      REQUIRE(taken <= allowed);
      shortest = std::min(shortest, taken);
      judge_with(pace, taken, 0);
      REQUIRE(pace.time <= total);
    }
    if (total < 2000 * allowed) CHECK(pace.time == total);
    CHECK(shortest >= std::min(total, 0.499 * allowed));
    if (pace.time == total) CHECK(physics::next_step(pace, 0) == 0);
  }
}

TEST_CASE("a step that reaches the target takes the time there, whatever its sum rounds to") {
  Pace pace = pace_with(1e-6);
  pace.target = 1 + 0x1p-52;
  pace.time = 0x1p-53;  // target - time is 1, and time + 1 is 1
  pace.allowed = 10;
  judge_with(pace, physics::next_step(pace, 0), 0);
  CHECK(pace.time == pace.target);
}

TEST_CASE("a step stands if its error is within the tolerance, and else nothing but the next length changes") {
  for (const float estimate : {0.0f, 0.5e-6f, 0.999e-6f, 1.001e-6f, 1.0f, std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN()}) {
    CAPTURE(estimate);
    Pace pace = pace_with(1e-6);
    judge_with(pace, 0.01, estimate);
    const bool stands = estimate < 1e-6f;
    CHECK(pace.verdict == (stands ? physics::step_accepted : physics::step_rejected));
    CHECK(pace.time == (stands ? 0.01 : 0.0));
    CHECK(pace.accepted == (stands ? 1 : 0));
    CHECK(pace.rejected == (stands ? 0 : 1));
    CHECK((pace.estimate[0] == 0 && pace.estimate[1] == 0));
    if (!stands) CHECK((pace.allowed < 0.01 && pace.allowed >= 0.01 / 3 * (1 - 1e-12)));
  }
}

TEST_CASE("two estimates join as dop853's do, and an infinite second one rejects") {
  Pace pace = pace_with(1e-6);
  pace.estimate[1] = std::bit_cast<std::uint32_t>(100.0f);
  judge_with(pace, 0.01, 1e-3f);  // 1e-6 / sqrt(1e-6 + 100) = 1e-7
  CHECK(pace.verdict == physics::step_accepted);
  pace = pace_with(1e-6);
  pace.estimate[1] = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
  judge_with(pace, 0.01, 1e-9f);
  CHECK(pace.verdict == physics::step_rejected);
}

TEST_CASE("where the error is a power of the step, steps settle where it is just within the tolerance") {
  Pace pace = pace_with(1e-6);
  const auto error_of = [](double step) { return static_cast<float>(3 * std::pow(step, 8)); };
  for (int k = 0; k < 100; ++k) {
    const double taken = physics::next_step(pace, 0);
    judge_with(pace, taken, error_of(taken));
  }
  const double settled = physics::next_step(pace, 0);
  CHECK(error_of(settled) < 1e-6f);
  CHECK(error_of(1.2 * settled) > 1e-6f);
  CHECK(pace.rejected <= 2);
}

TEST_CASE("a step cut short for a target does not shorten those after it") {
  Pace pace = pace_with(1e-6);
  pace.allowed = 0.5;
  pace.target = 0.001;
  judge_with(pace, physics::next_step(pace, 0), 0.9e-6f);
  CHECK(pace.time == 0.001);
  CHECK(pace.allowed >= 0.5);
}

TEST_CASE("no step is longer than the longest one, and after a contact none is longer than the first") {
  Pace pace = pace_with(1e-6);
  for (int k = 0; k < 20; ++k) judge_with(pace, physics::next_step(pace, 0), 0);
  CHECK(physics::next_step(pace, 0) == pace.largest_step);
  CHECK(physics::next_step(pace, 1) == pace.first_step);
  physics::start_anew(pace, 1);
  CHECK(physics::next_step(pace, 1) == pace.first_step);
}

}  // namespace pliant
