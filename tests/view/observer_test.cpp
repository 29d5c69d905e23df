// What is told of a simulation while it plays.
#include "view/observer.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "support/collision_scene.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

/// An observer whose clock stands where it is put.
struct Watched {
  double time = 0;
  Observer observer{[this] { return time; }};

  void look(Session& session, double at) {
    time = at;
    observer.look(session);
  }
  [[nodiscard]] const Observation& seen() const { return observer.observation(); }
};

LoadedScene touching_spheres(const char* response = "impulse") {
  LoadedScene scene;
  scene.description.collision.response.value = response;
  scene.description.simulation.time_step = 0.01;
  scene.description.simulation.damping_law = DampingLaw::none;
  scene.start = build_model(colliding_spheres(), {0, 0, 0});
  return scene;
}

TEST_CASE("an observer samples energy and contacts ten times a second") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, touching_spheres());
  Watched watched;
  double touching = 0;
  for (int k = 0; k < 60; ++k) {
    session.step_once();
    watched.look(session, 1000 + 0.02 * k);
  }
  const Observation& seen = watched.seen();
  CHECK(seen.energy.values().size() >= 8);
  CHECK(seen.energy.values().size() <= 12);
  CHECK(seen.energy.values().front() ==
        Approx(measure(session.model(), session.start(), {0, 0, 0}, *std::make_unique<ThreadPool>(1)).energy()).epsilon(1e-3));
  for (const float value : seen.touching.values()) touching += value;
  CHECK(touching > 0);
  CHECK(seen.passes.empty());
}

TEST_CASE("an observer counts the vertices that reflection turned back, and each at most once") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, touching_spheres("reflect"));
  Watched watched;
  for (int k = 0; k < 60; ++k) {
    session.step_once();
    watched.look(session, 1000 + 0.02 * k);
  }
  double touching = 0;
  for (const float value : watched.seen().touching.values()) touching += value;
  CHECK(touching > 0);
  CHECK(touching <= static_cast<double>(session.report().reverted_vertices));
}

TEST_CASE("samples take a tenth of the time at most, however long one takes") {
  const auto device = make_cpu_device(1, 32);
  Session session(*device, touching_spheres());
  constexpr double a_sample = 0.3;  // [s]
  double time = 0;
  bool is_sampling = false;  // between two looks at the clock a sample has been taken
  Observer observer([&] { return time += std::exchange(is_sampling, true) ? a_sample : 0; });
  for (int k = 0; k < 300; ++k) {
    session.step_once();
    is_sampling = false;
    observer.look(session);
    time += 0.15;
  }
  const double sampling = a_sample * static_cast<double>(observer.observation().energy.values().size());
  CHECK(sampling <= 0.1 * time + a_sample);
  CHECK(sampling >= 0.09 * time);
}

TEST_CASE("an observer counts from its first sample on, whatever happened before it looked") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, touching_spheres("reflect"));
  Watched watched;
  const auto step_until_touched = [&] {
    const std::uint64_t before = session.report().reverted_vertices;
    while (session.report().reverted_vertices == before) session.step_once();
    return static_cast<float>(session.report().reverted_vertices - before);
  };
  session.time_passes(true);
  step_until_touched();
  watched.look(session, 0);
  CHECK(watched.seen().energy.values().size() == 1);
  CHECK(watched.seen().touching.values().empty());
  CHECK(watched.seen().passes.empty());
  CHECK(watched.seen().step_milliseconds == 0);
  const float touched = step_until_touched();
  watched.look(session, 1);
  CHECK(watched.seen().touching.values() == std::vector{touched});
  CHECK(watched.seen().step_milliseconds > 0);

  watched.observer.count_anew();
  step_until_touched();
  watched.look(session, 2);
  CHECK(watched.seen().touching.values() == std::vector{touched});
  const float touched_later = step_until_touched();
  watched.look(session, 3);
  CHECK(watched.seen().touching.values() == std::vector{touched, touched_later});
}

TEST_CASE("what steps take is told of single ones as well, and of those made anew on the way back") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, touching_spheres());
  session.advance_toward(0.1, 10);
  REQUIRE(session.stepping().steps == 10);
  const double seconds = session.stepping().seconds;
  CHECK(seconds > 0);
  REQUIRE(session.step_back());
  CHECK(session.step() == 9);
  CHECK(session.stepping().steps == 19);
  CHECK(session.stepping().seconds > seconds);
  Watched watched;
  watched.look(session, 0);
  const double seconds_before = session.stepping().seconds;
  session.step_once();
  watched.look(session, 1);
  CHECK(watched.seen().step_milliseconds > 0);
  CHECK(watched.seen().step_milliseconds == Approx(1e3 * (session.stepping().seconds - seconds_before)));
}

TEST_CASE("passes are told while they are timed, the slowest first") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, touching_spheres());
  Watched watched;
  session.time_passes(true);
  for (int k = 0; k < 3; ++k) {
    session.step_once();
    watched.look(session, k);
  }
  const std::vector<PassTime>& passes = watched.seen().passes;
  REQUIRE(passes.size() > 3);
  for (std::size_t k = 1; k < passes.size(); ++k) CHECK(passes[k].milliseconds <= passes[k - 1].milliseconds);
  session.time_passes(false);
  session.step_once();
  watched.look(session, 10);
  CHECK(watched.seen().passes.empty());
}

TEST_CASE("a series keeps the latest numbers, as many as a plot shows") {
  Series series;
  for (int k = 0; k < 1000; ++k) series.add(k);
  CHECK(series.values().size() == Series::most);
  CHECK(series.values().back() == 999);
}

}  // namespace
