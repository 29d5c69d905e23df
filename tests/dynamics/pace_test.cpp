// The controller of adaptive steps by itself, physics/pace.glsl, and how many steps are queued for it.
#include <bit>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "dynamics/pacer.hpp"

namespace pliant {
namespace {

using physics::Pace;

Pace pace_with(double tolerance) {
  Pace pace{};
  pace.target = 1e9;
  pace.tolerance = tolerance;
  pace.allowed = pace.first_step = 0.01;
  pace.largest_step = 1;
  pace.largest_motion = 0.2;
  pace.estimate_order = 8;
  pace.error_before = physics::aimed_error();
  physics::forget_step(pace);
  return pace;
}

// Judges a step as if the largest error of a vertex were this.
void judge_with(Pace& pace, double taken, float error) {
  pace.error = std::bit_cast<std::uint32_t>(error);
  physics::judge(pace, taken);
}

// Adds a touching vertex that has gone this way in the step [m].
void touch(Pace& pace, glm::vec3 way) {
  const auto extend = [](std::uint32_t& least, std::uint32_t& most, float coordinate) {
    least = std::min(least, physics::ordered_bits(coordinate));
    most = std::max(most, physics::ordered_bits(coordinate));
  };
  extend(pace.least_x, pace.most_x, way.x);
  extend(pace.least_y, pace.most_y, way.y);
  extend(pace.least_z, pace.most_z, way.z);
}

// Judges steps with the errors of this function until one ends the run or the run comes to its end. Gives up after `most` steps.
template <class Error>
Pace run_with(Pace pace, Error error_of, int most = 10'000) {
  for (int k = 0; k < most && pace.failure == physics::no_failure && pace.time < pace.target; ++k) {
    const double taken = physics::next_step(pace);
    judge_with(pace, taken, error_of(taken));
  }
  return pace;
}

// How many steps the controller takes to a target if each has this error.
std::uint64_t steps_taken(Pace pace, double target, float error) {
  pace.target = target;
  while (pace.time < target) judge_with(pace, physics::next_step(pace), error);
  return pace.accepted;
}

float joined(float e, float f) {
  return std::bit_cast<float>(physics::joined_error(std::bit_cast<std::uint32_t>(e), std::bit_cast<std::uint32_t>(f)));
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
      const double taken = physics::next_step(pace);
      REQUIRE(taken > 0);
      REQUIRE(taken <= allowed);
      shortest = std::min(shortest, taken);
      judge_with(pace, taken, 0);
      REQUIRE(pace.time <= total);
    }
    if (total < 2000 * allowed) CHECK(pace.time == total);
    CHECK(shortest >= std::min(total, 0.499 * allowed));
    if (pace.time == total) CHECK(physics::next_step(pace) == 0);
  }
}

TEST_CASE("a step that reaches the target takes the time there, whatever its sum rounds to") {
  Pace pace = pace_with(1e-6);
  pace.target = 1 + 0x1p-52;
  pace.time = 0x1p-53;  // target - time is 1, and time + 1 is 1
  pace.allowed = 10;
  judge_with(pace, physics::next_step(pace), 0);
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
    CHECK(pace.error == 0);
    if (!stands) CHECK((pace.allowed < 0.01 && pace.allowed >= 0.01 / 3 * (1 - 1e-12)));
  }
}

TEST_CASE("two estimates join as dop853's do, and an infinite one is an infinite error") {
  CHECK(joined(1e-3f, 100.0f) == Approx(1e-7));  // 1e-6 / sqrt(1e-6 + 100)
  CHECK(joined(1e-3f, 0.0f) == 1e-3f);
  CHECK(joined(0.0f, 0.0f) == 0);
  for (const float broken : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    CHECK(std::isinf(joined(1e-9f, broken)));
    CHECK(std::isinf(joined(broken, 1.0f)));
  }
}

TEST_CASE("where the error is a power of the step, steps settle where it is just within the tolerance") {
  Pace pace = pace_with(1e-6);
  const auto error_of = [](double step) { return static_cast<float>(3 * std::pow(step, 8)); };
  for (int k = 0; k < 100; ++k) {
    const double taken = physics::next_step(pace);
    judge_with(pace, taken, error_of(taken));
  }
  const double settled = physics::next_step(pace);
  CHECK(error_of(settled) < 1e-6f);
  CHECK(error_of(1.4 * settled) > 1e-6f);
  CHECK(pace.rejected <= 2);
}

TEST_CASE("a step cut short for a target shortens those after it only if its error is nearly too large") {
  for (const float estimate : {0.0f, 0.09e-6f, 0.4e-6f, 0.9e-6f}) {
    CAPTURE(estimate);
    Pace pace = pace_with(1e-6);
    pace.allowed = 0.5;
    pace.target = 0.001;
    judge_with(pace, physics::next_step(pace), estimate);
    CHECK(pace.time == 0.001);
    if (estimate < 0.5e-6f)
      CHECK(pace.allowed >= 0.5);
    else
      CHECK(pace.allowed < 0.001);
  }
}

TEST_CASE("a step cut short for a target lets those after it grow, but for one right after a rejection") {
  for (const bool rejected_before : {false, true}) {
    Pace pace = pace_with(1e-6);
    pace.allowed = 0.5;
    pace.target = 0.4;
    pace.rejected_before = rejected_before ? 1 : 0;
    judge_with(pace, physics::next_step(pace), 1e-7f / 256);  // a free step twice as long would have the aimed error
    CHECK(pace.allowed == Approx(rejected_before ? 0.5 : 0.8).epsilon(1e-4));
  }
}

TEST_CASE("targets up to a free step apart cost a step each and no rejection, however long steps were before") {
  for (const double first : {0.001, 0.02, 1.0})
    for (const double apart : {0.1, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99}) {
      CAPTURE(first, apart);
      Pace pace = pace_with(1e-6);
      pace.allowed = pace.first_step = first;
      pace.largest_step = 100;
      pace.target = 0;
      for (int frame = 1; frame <= 100; ++frame) {
        pace.target += apart;
        while (pace.time < pace.target) {
          const double taken = physics::next_step(pace);
          judge_with(pace, taken, static_cast<float>(1e-7 * std::pow(taken, 8)));  // a free step is 1 s long
        }
        if (frame == 20) pace.accepted = 0;
      }
      CHECK(pace.accepted == 80);
      CHECK(pace.rejected == 0);
    }
}

TEST_CASE("queued steps are no more than smooth motion takes, and at most one fewer") {
  const Pace at_start = pace_with(1e-6);
  Pace steady = at_start;
  for (int k = 0; k < 40; ++k) judge_with(steady, physics::next_step(steady), 1e-7f);
  Pace after_contact = at_start;
  for (int k = 0; k < 10; ++k) judge_with(after_contact, physics::next_step(after_contact), 0);
  touch(after_contact, {0.01f, 0, 0});
  judge_with(after_contact, physics::next_step(after_contact), 0);
  CHECK(after_contact.allowed < 0.02);
  for (const double time : {1e-6, 0.01, 0.0123, 0.05, 1.7, 10.0}) {
    CAPTURE(time);
    for (const auto& [pace, error] : {std::pair(at_start, 0.0f), std::pair(steady, 1e-7f), std::pair(after_contact, 0.0f)}) {
      const std::uint64_t taken = steps_taken(pace, pace.time + time, error) - pace.accepted;
      const std::uint64_t queued = steps_toward(pace.time + time, pace, 10'000);
      CHECK(queued <= taken);
      CHECK(queued + 1 >= taken);
    }
  }
  CHECK(steps_toward(at_start.time, at_start, 1000) == 0);
  CHECK(steps_toward(1e9, at_start, 32) == 32);
}

TEST_CASE("no step is longer than the longest one") {
  Pace pace = pace_with(1e-6);
  for (int k = 0; k < 20; ++k) judge_with(pace, physics::next_step(pace), 0);
  CHECK(physics::next_step(pace) == pace.largest_step);
}

TEST_CASE("the step after a contact is no longer than the first, however little the bodies moved") {
  Pace pace = pace_with(1e-6);
  for (int k = 0; k < 20; ++k) judge_with(pace, physics::next_step(pace), 0);
  touch(pace, {0, 0, 0});
  judge_with(pace, 1, 0);
  CHECK(pace.verdict == physics::step_accepted);
  CHECK(physics::next_step(pace) == pace.first_step);
  judge_with(pace, pace.first_step, 0);
  CHECK(physics::next_step(pace) > pace.first_step);
}

TEST_CASE("a step with a contact stands if no two touching vertices went too far against each other") {
  for (const float way : {0.19f, 0.21f}) {
    Pace pace = pace_with(1e-6);
    const glm::vec3 common(7, -300, 20), across = way * glm::vec3(2, -1, 2) / 3.0f;
    touch(pace, common + across);
    touch(pace, common);
    judge_with(pace, 0.01, 0);
    CHECK(pace.verdict == (way < 0.2f ? physics::step_accepted : physics::step_rejected));
    CHECK(pace.rejected_in_contact == (way < 0.2f ? 0 : 1));
    CHECK(pace.time == (way < 0.2f ? 0.01 : 0));
    CHECK(physics::next_step(pace) == Approx(0.8 * 0.01 * 0.2 / way).epsilon(1e-3));
    judge_with(pace, physics::next_step(pace), 0);  // without contacts
    CHECK(pace.verdict == physics::step_accepted);
  }
}

TEST_CASE("where a step was undone for a contact steps stay short, and beyond it grow again") {
  Pace pace = pace_with(1e-6);
  pace.allowed = 1;
  touch(pace, {0, 0, 0});
  touch(pace, {40, 0, 0});
  judge_with(pace, 1, 0);
  const double step = physics::next_step(pace);
  CHECK(step == Approx(0.8 * 0.2 / 40).epsilon(1e-3));
  while (pace.time + step < 1) {
    REQUIRE(physics::next_step(pace) == step);
    judge_with(pace, step, 0);
  }
  judge_with(pace, physics::next_step(pace), 0);
  judge_with(pace, physics::next_step(pace), 0);
  CHECK(physics::next_step(pace) > 2 * step);
}

TEST_CASE("an error that is too large counts before a contact, and says nothing of it") {
  Pace pace = pace_with(1e-6);
  touch(pace, {0, 0, 0});
  touch(pace, {40, 0, 0});
  judge_with(pace, 0.01, 1);
  CHECK((pace.rejected == 1 && pace.rejected_in_contact == 0));
  CHECK(physics::next_step(pace) >= 0.01 / 3 * (1 - 1e-12));
}

TEST_CASE("the shortest step stands in contact, and with too large an error says so") {
  Pace pace = pace_with(1e-6);
  const double shortest = physics::shortest_step(pace);
  touch(pace, {0, 0, 0});
  touch(pace, {40, 0, 0});
  judge_with(pace, shortest, 0);
  CHECK((pace.accepted == 1 && pace.failed_step == 0));
  judge_with(pace, physics::shortest_step(pace), 1);
  CHECK((pace.accepted == 2 && pace.failed_step == physics::shortest_step(pace_with(1e-6))));
}

TEST_CASE("an error that three halvings do not lower ends the run") {
  for (const float error : {1.1e-6f, 1e-3f, 1e30f}) {
    CAPTURE(error);
    const Pace pace = run_with(pace_with(1e-6), [&](double) { return error; });
    CHECK(pace.failure == physics::no_length_meets);
    CHECK(pace.failed_step == pace.time);
    CHECK((pace.failed_step <= 0.01 / 8 && pace.failed_step > 0.01 / 8 / 3.01));
  }
}

TEST_CASE("an error that falls, however slowly and unevenly, or is infinite at first ends no run") {
  const auto slowly = [](double step) { return static_cast<float>(1e-3 * std::cbrt(step)); };
  const auto unevenly = [k = 0](double step) mutable { return static_cast<float>((k++ % 2 == 0 ? 2 : 1) * step * step); };
  const auto infinitely = [](double step) { return step > 1e-6 ? std::numeric_limits<float>::infinity() : 0.0f; };
  Pace pace = pace_with(1e-6);
  pace.target = 0.001;
  CHECK(run_with(pace, slowly).failure == physics::no_failure);
  CHECK(run_with(pace, unevenly).failure == physics::no_failure);
  CHECK(run_with(pace, infinitely).failure == physics::no_failure);
}

// The error behaves as if forces in fp32 round: nothing is wrong with steps so short that nothing moves.
TEST_CASE("a run ends where the steps left at its pace are more than it may have, and else goes on") {
  for (const double length : {1e-10, 1e-12}) {
    const auto rounding = [&](double step) { return step < length ? 0.0f : static_cast<float>(step); };
    CAPTURE(length);
    Pace pace = pace_with(1e-30);
    pace.end = pace.target = 1;
    const Pace too_long = run_with(pace, rounding);
    CHECK(too_long.failure == physics::too_many_steps);
    CHECK((too_long.failed_step > length / 10 && too_long.failed_step < 10 * length && too_long.time < 1e-5));
    pace.end = pace.target = 1e7 * length;  // an average step is longer than a tenth of `length`
    CHECK(run_with(pace, rounding, 3'000).failure == physics::no_failure);
  }
}

TEST_CASE("a run ends where steps of the aimed error are too many, too") {
  Pace pace = pace_with(1e-13);
  pace.end = pace.target = 1;
  const Pace ended = run_with(pace, [](double step) { return static_cast<float>(step); });
  CHECK((ended.failure == physics::too_many_steps && ended.rejected < 100));
  CHECK(ended.failed_step == Approx(1e-14).epsilon(0.01));
}

TEST_CASE("short steps on the way past a kink, or in contact, end no run") {
  Pace pace = pace_with(1e-13);
  pace.end = pace.target = 1e3;
  // Each straddles the kink at 0.1 s until it is short enough: far below 1e3 / 3e8.
  const auto kinked = [&](double step) {
    const bool straddles = pace.time < 0.1 && pace.time + step > 0.1;
    return static_cast<float>(straddles ? step * step : 1e-13 * std::pow(step, 8));
  };
  double shortest = 1;
  for (int k = 0; k < 20'000 && pace.failure == physics::no_failure && pace.time < pace.target; ++k) {
    const double taken = physics::next_step(pace);
    shortest = std::min(shortest, taken);
    judge_with(pace, taken, kinked(taken));
  }
  CHECK(shortest < 1e3 / 3e8);
  CHECK(pace.time == pace.target);
  pace = pace_with(1e-6);
  pace.end = pace.target = 1e12;
  for (int k = 0; k < 5'000; ++k) {
    touch(pace, {1e-3f, 0, 0});
    touch(pace, {0, 0, 0});
    judge_with(pace, physics::next_step(pace), 0);
  }
  CHECK((pace.failure == physics::no_failure && pace.accepted == 5'000));
}

}  // namespace pliant
