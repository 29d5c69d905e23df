// Runs that a program drives. tests/python has more of them.
#include "run/driven_run.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <thread>

#include "core/error.hpp"
#include "gl/context.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

// Two small spheres that meet after some 20 steps.
RunOptions meeting(const std::string& timing = "time_step = 0.002", const std::string& device = "cpu") {
  RunOptions options;
  options.scene = "meeting";
  options.scene_text = "[simulation]\n" + timing +
                       "\nduration = 0.1\n[[body]]\nname = \"left\"\nmesh = \"icosphere:1\"\nposition = [-1.1, 0.1, 0]\n"
                       "velocity = [4, 0, 0]\nspin = [0, 1, 0]\n[[body]]\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\n"
                       "stretch = [0.9, 1, 1]\n";
  options.device.wish = device == "gpu" ? DeviceWish::gpu : DeviceWish::cpu;
  options.device.threads = 2;
  options.quiet = true;
  return options;
}

constexpr const char* by_tolerance = "integrator = \"dop853\"\ntolerance = 1e-6";

bool have_same_bits(const State& a, const State& b) {
  return a.motion.size() == b.motion.size() &&
         std::memcmp(a.motion.data(), b.motion.data(), a.motion.size() * sizeof(double)) == 0;
}

TEST_CASE("steps that are stopped go on with the same bits", "[gl]") {
  for (const char* timing : {"time_step = 0.002", by_tolerance}) {
    CAPTURE(timing);
    DrivenRun whole(meeting(timing)), stopped(meeting(timing));
    whole.advance_to(0.1);
    int stops = 0, calls = 0;
    for (; stopped.report().time < 0.1 - 1e-9; ++calls) stopped.advance_to(0.1, [&] { return ++stops % 2 == 0; });
    CHECK(calls > 2);
    CHECK(stopped.report().steps == whole.report().steps);
    CHECK(have_same_bits(stopped.state(), whole.state()));
  }
}

TEST_CASE("a saved run goes on in another one, also of another material and precision", "[gl]") {
  DrivenRun run(meeting());
  run.advance(20);
  run.go_on_with(std::array{Material{10, 1, 0.5}, Material{40, 2, 1}});
  run.advance(5);
  const std::string saved = run.save();
  run.advance(20);
  DrivenRun same(meeting());
  same.restore(saved);
  CHECK(same.model().bodies[0].stiffness == 10);
  CHECK(same.report().steps == 25);
  same.advance(20);
  CHECK(have_same_bits(same.state(), run.state()));

  RunOptions finer = meeting();
  finer.device.precision = 64;
  DrivenRun other(finer);
  other.restore(saved);
  other.advance(20);
  const State a = other.state(), b = run.state();
  double farthest = 0;
  for (std::size_t i = 0; i < run.model().vertex_count(); ++i)
    farthest = std::max(farthest, glm::distance(a.world_position(run.model(), i), b.world_position(run.model(), i)));
  CHECK(farthest < 1e-4);
  CHECK(farthest > 0);
}

TEST_CASE("bodies that would intersect leave the run as it was") {
  DrivenRun run(meeting());
  run.advance(5);
  const State before = run.state();
  State together = before;
  together.poses[1] = together.poses[0];
  CHECK_THROWS_AS(run.go_on_with(together), Error);
  CHECK(have_same_bits(run.state(), before));
  run.advance(5);
  CHECK(run.report().steps == 10);
}

TEST_CASE("a run on a GPU and its pictures belong to a thread", "[gl]") {
  if (test::lacks_gl()) return;
  DrivenRun on_gpu(meeting("time_step = 0.002", "gpu")), drawn(meeting());
  static_cast<void>(drawn.render(drawn.scene().output));
  for (DrivenRun* run : {&on_gpu, &drawn}) {
    std::string told;
    std::thread([&] {
      try {
        run->advance(1);
      } catch (const Error& error) {
        told = error.what();
      }
    }).join();
    CHECK_THAT(told, Catch::Contains("another thread"));
    run->advance(1);
    CHECK(run->report().steps == 1);
  }
}

}  // namespace
}  // namespace pliant
