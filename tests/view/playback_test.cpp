// Simulated time against real time, both of them numbers.
#include "view/playback.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pliant::view;

namespace {

/// A simulation of fixed steps, and a clock that they move.
struct Show {
  double time_step = 0.002, cost = 0;  // simulated and real time of a step [s]
  double now = 100;                    // [s]
  int steps = 0;

  [[nodiscard]] double simulated() const { return steps * time_step; }
  [[nodiscard]] bool is_before(double goal) const { return simulated() + time_step <= goal * (1 + 1e-12); }

  void picture(Playback& playback) {
    playback.begin(now, simulated());
    while (is_before(playback.goal()) && playback.has_time(now)) {
      ++steps;
      now += cost;
    }
    playback.end(now, simulated(), !is_before(playback.goal()));
  }
  /// Makes pictures that begin every `interval` [s], or as soon as the one before is done.
  void run(Playback& playback, double seconds, double interval) {
    const double end = now + seconds;
    while (now < end - 1e-9) {
      const double next = now + interval;
      picture(playback);
      now = std::max(now, next);
    }
    picture(playback);
  }
};

TEST_CASE("a second of real time makes a second of simulated time, whatever the frame rate and the step") {
  for (const double rate : {7.0, 30.0, 60.0, 144.0, 1000.0}) {
    for (const double time_step : {0.0005, 0.002, 0.03, 0.4}) {
      CAPTURE(rate, time_step);
      Playback playback({});
      Show show{.time_step = time_step};
      show.run(playback, 1, 1 / rate);
      CHECK(show.simulated() <= 1 + 1e-9);
      CHECK(show.simulated() > 1 - time_step - 1e-9);
      CHECK(playback.factor() == 1);
    }
  }
}

TEST_CASE("a factor makes simulated time faster or slower") {
  for (const double speed : {0.01, 0.5, 3.0}) {
    Playback playback({.speed = speed});
    Show show;
    show.run(playback, 2, 1.0 / 60);
    CHECK(show.simulated() == Approx(2 * speed).margin(show.time_step));
    CHECK(playback.factor() == speed);
  }
}

TEST_CASE("a pause makes no simulated time, and none is made up for afterwards") {
  Playback playback({});
  Show show;
  show.run(playback, 0.5, 1.0 / 60);
  playback.toggle_pause();
  const int before = show.steps;
  show.run(playback, 30, 1.0 / 60);
  CHECK(show.steps == before);
  playback.toggle_pause();
  show.run(playback, 0.5, 1.0 / 60);
  CHECK(show.simulated() == Approx(1).margin(2 * show.time_step + 1.0 / 60));
  CHECK(show.simulated() <= 1);
}

TEST_CASE("a pause that no picture saw makes no simulated time either") {
  Playback playback({});
  Show show;
  show.run(playback, 0.5, 1.0 / 60);
  const int before = show.steps;
  playback.toggle_pause();
  show.now += 1000;
  playback.toggle_pause();
  show.picture(playback);
  CHECK(show.steps == before);
}

TEST_CASE("a single step in a pause is the only one") {
  Playback playback({});
  Show show;
  playback.pause();
  show.picture(playback);
  ++show.steps;
  show.now += 1;
  show.picture(playback);
  CHECK(show.steps == 1);
}

TEST_CASE("a device that is too slow steps within its budget and is told by how much") {
  Playback playback({.speed = 1, .budget = 0.012});
  Show show{.time_step = 0.002, .cost = 0.003};  // 4 steps fit the budget of a picture, 8 were needed
  const double start = show.now;
  show.run(playback, 3, 1.0 / 60);
  CHECK(show.simulated() == Approx(0.008 * 60 * (show.now - start)).epsilon(0.02));
  CHECK(playback.factor() == Approx(0.48).epsilon(0.03));
}

TEST_CASE("a picture that takes long drops nothing, and later ones make up for its steps") {
  Playback playback({.speed = 1, .budget = 0.012});
  Show show{.time_step = 0.002, .cost = 0.0005};
  show.run(playback, 1, 1.0 / 60);
  show.cost = 0.05;  // one step, and then no more
  show.now += 1.0 / 60;
  const double began = show.now;
  show.picture(playback);
  CHECK(show.now > began + 0.04);
  show.cost = 0.0005;
  show.run(playback, 1, 1.0 / 60);
  CHECK(playback.dropped() == 0);
  CHECK(playback.factor() == 1);
  CHECK(show.simulated() <= show.now - 100);
  CHECK(show.simulated() > show.now - 100 - 0.01);
}

TEST_CASE("a device that is too slow for a second drops that time but for a tenth of a second, and catches up with that") {
  for (const double speed : {1.0, 0.5}) {
    Playback playback({.speed = speed, .budget = 0.012});
    Show show{.time_step = 0.002, .cost = 0.024 / speed};
    show.run(playback, 1, 1.0 / 60);
    const double behind = (show.now - 100) * speed - show.simulated();
    const double dropped = playback.dropped();
    CHECK(dropped > 0.3 * speed);
    CHECK(dropped == Approx(behind - 0.1 * speed).margin(0.03));  // a picture's time
    CHECK(playback.factor() < speed);
    show.cost = 0;
    show.run(playback, 1, 1.0 / 60);
    CHECK(playback.dropped() == dropped);
    CHECK(show.simulated() == Approx((show.now - 100) * speed - dropped).margin(2 * show.time_step));
  }
}

TEST_CASE("catching up is not told as more than the speed") {
  Playback playback({.speed = 1, .budget = 0.012});
  Show show{.time_step = 0.002, .cost = 0.0002};
  show.run(playback, 0.85, 1.0 / 60);
  show.now += 1.0 / 60;
  show.cost = 0.3;
  show.picture(playback);
  show.cost = 0.0002;
  double least = 1;
  for (int k = 0; k < 90; ++k) {
    show.run(playback, 1.0 / 60, 1.0 / 60);
    CHECK(playback.factor() <= 1);
    least = std::min(least, playback.factor());
  }
  CHECK(playback.dropped() > 0.05);
  CHECK(least == Approx(1 - playback.dropped() / 0.5).margin(0.1));
  CHECK(playback.factor() == 1);
}

TEST_CASE("a speed that changes is told by the share of time that was dropped before") {
  Playback playback({.speed = 4, .budget = 0.012});
  Show show{.time_step = 0.002, .cost = 0.003};  // 4 steps fit the budget of a picture, 33 were needed
  show.run(playback, 2, 1.0 / 60);
  CHECK(playback.factor() == Approx(0.48).epsilon(0.1));
  playback.set_speed(0.4);
  show.run(playback, 0.51, 1.0 / 60);
  CHECK(playback.factor() > 0.04);
  show.run(playback, 2, 1.0 / 60);
  CHECK(playback.factor() == 0.4);
}

TEST_CASE("where drawing takes long, so may stepping") {
  Playback playback({.speed = 1, .budget = 0.012});
  Show show{.time_step = 0.002, .cost = 0.004};
  const double start = show.now;
  for (int k = 0; k < 40; ++k) {
    show.picture(playback);
    show.now += 0.2;  // for drawing
  }
  CHECK(show.steps * show.cost > 0.4 * (show.now - start));
}

TEST_CASE("a single step longer than the budget still is made") {
  Playback playback({});
  Show show{.time_step = 0.002, .cost = 0.2};
  show.run(playback, 2, 1.0 / 60);
  CHECK(show.steps >= 9);
  CHECK(playback.factor() == Approx(0.01).epsilon(0.2));
}

TEST_CASE("time dropped is not made up for, and a device that keeps up again is not told of any more") {
  Playback playback({});
  Show show{.time_step = 0.002, .cost = 0.02};
  show.run(playback, 2, 1.0 / 60);
  CHECK(playback.factor() < 0.2);
  show.cost = 0;
  const double before = show.simulated();
  show.run(playback, 2, 1.0 / 60);
  CHECK(show.simulated() - before == Approx(2 + 0.1).margin(0.04));
  CHECK(playback.factor() == 1);
}

TEST_CASE("a simulation put back goes on from there in step with real time") {
  Playback playback({});
  Show show;
  show.run(playback, 1, 1.0 / 60);
  show.steps = 0;
  playback.restart();
  show.run(playback, 1, 1.0 / 60);
  CHECK(show.simulated() == Approx(1).margin(show.time_step));
}

TEST_CASE("batches of steps settle at a few milliseconds, or at one step where that takes longer") {
  for (const double cost : {1e-6, 0.0003, 0.002, 0.5}) {
    CAPTURE(cost);
    BatchSize batch;
    for (int k = 0; k < 20; ++k) batch.took(cost * static_cast<double>(batch.steps()));
    const double seconds = cost * static_cast<double>(batch.steps());
    CHECK((seconds >= 0.001 || batch.steps() == 32));
    CHECK((seconds <= 0.003 || batch.steps() == 1));
    for (int k = 0; k < 20; ++k) batch.took(1);
    CHECK(batch.steps() == 1);
  }
}

}  // namespace
