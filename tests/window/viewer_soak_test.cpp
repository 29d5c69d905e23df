// The viewer for ten minutes.
#include <catch2/catch.hpp>
#include <chrono>
#include <string>

#include "support/resident_memory.hpp"
#include "support/viewed.hpp"

using namespace pliant;
using namespace pliant::test;

namespace {

// The states that the viewer can go back to fill their room in the first minutes.
TEST_CASE("a viewer that plays for ten minutes needs no more memory than after six", "[.soak][gl]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(
      display, folder, "cpu",
      {"--set", "body.body0.mesh=icosphere:3", "--set", "body.body1.mesh=icosphere:3", "--set", "simulation.time_step=auto"});
  viewed.press("Tab");
  viewed.press("space");
  const auto play_until = [&, began = std::chrono::steady_clock::now()](std::chrono::minutes end) {
    viewed.await([&](const ReadJson&) { return std::chrono::steady_clock::now() - began > end; }, end + std::chrono::minutes(1));
    return resident_memory(std::to_string(viewed.program().id()));
  };
  const double after_six = play_until(std::chrono::minutes(6)), after_ten = play_until(std::chrono::minutes(10));
  WARN("after 6 minutes " << after_six << " MiB, after 10 " << after_ten);
  CHECK(after_ten - after_six < 4);
  CHECK_FALSE(viewed.await([](const ReadJson&) { return true; })["paused"].get<bool>());
}

}  // namespace
