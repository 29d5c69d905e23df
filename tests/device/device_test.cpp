// Arrays on a device, and what is read from them.
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "support/evolve.hpp"

namespace pliant {
namespace {

// Whatever was read ahead, reading gives what is there now.
TEST_CASE("what is read ahead is never outdated", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Device& device = *test.device;
    DeviceArray<std::uint32_t> small(device, 3, "small"), other(device, 5, "other"), large(device, (1 << 18) + 1, "large");
    small.upload(std::vector<std::uint32_t>{1, 2, 3});
    other.upload(std::vector<std::uint32_t>{4, 5, 6, 7, 8});
    device.read_ahead(std::array{other.id(), small.id()});
    CHECK(small.download() == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(other.download(3, 2) == std::vector<std::uint32_t>{7, 8});
    small.upload(std::vector<std::uint32_t>{9, 2, 3});
    CHECK(small.download() == std::vector<std::uint32_t>{9, 2, 3});
    device.read_ahead(std::array{small.id(), large.id()});  // more than is read ahead at once
    CHECK(large.download() == std::vector<std::uint32_t>((1 << 18) + 1));
    CHECK(small.download() == std::vector<std::uint32_t>{9, 2, 3});
    {
      DeviceArray<std::uint32_t> brief(device, 2, "brief");
      device.read_ahead(std::array{brief.id()});
    }
    CHECK(other.download() == std::vector<std::uint32_t>{4, 5, 6, 7, 8});
    Arrays arrays(device);
    const auto& pace = arrays.make<physics::Pace>("pace", 1);
    arrays.make<physics::Control>("control", 1);  // of a step without a length
    device.read_ahead(std::array{pace.id()});
    device.run(std::array{make_pass(arrays, "judge_step", {}, 1)});
    CHECK(pace.download().front().verdict == physics::step_empty);
  }
}

}  // namespace
}  // namespace pliant
