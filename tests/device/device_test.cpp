// Arrays on a device, and what is read from them.
#include <array>
#include <catch2/catch.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "device/gpu/gpu_device.hpp"
#include "support/contract.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"

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

TEST_CASE("arrays begin as zeros, wherever others have been", "[gl]") {
  for (const TestDevice& test : all_devices())
    for (const std::size_t count : {1u, 16'383u, 16'384u, 16'385u, 1u << 18}) {
      CAPTURE(test.name, count);
      for (int round = 0; round < 3; ++round) {
        DeviceArray<std::uint32_t> array(*test.device, count, "array");
        CHECK(array.download() == std::vector<std::uint32_t>(count));
        array.upload(std::vector<std::uint32_t>(count, ~0u));
      }
    }
}

TEST_CASE("a kernel that was built for one caller is not another caller's", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const KernelId kernel = device->kernel("bound_bodies");
  CHECK(device->kernel("bound_bodies") == kernel);
  CHECK_THROWS_AS(device->round_kernel("bound_bodies"), Error);  // it has no rounds
}

TEST_CASE("a GPU with too little free memory is told so before the driver takes other memory") {
  CHECK_NOTHROW(gpu::expect_room(400, 600, 1000));
  CHECK_NOTHROW(gpu::expect_room(~std::uint64_t{0}, 600, 0));  // the driver does not tell
  CHECK_THROWS_WITH(gpu::expect_room(401'000'000, 600'000'000, 1'000'000'000),
                    Catch::Contains("1000.0 MB were free, and 1001.0 MB are needed at least"));
}

// The second quarter of a buffer, as a part. The whole buffer holds 0, 1, 2, ...
struct Quarter {
  explicit Quarter(Device& device)
      : whole(device, 4 * count, "whole"), part(device, device.part_of(whole.id(), part_alignment, part_alignment), count) {
    std::vector<std::uint32_t> values(4 * count);
    std::iota(values.begin(), values.end(), 0u);
    whole.upload(values);
  }
  static constexpr std::uint32_t count = part_alignment / sizeof(std::uint32_t);
  DeviceArray<std::uint32_t> whole, part;
};

TEST_CASE("a part of a buffer is read and written where it lies, and read ahead", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Quarter quarter(*test.device);
    CHECK(test.device->size_of(quarter.part.id()) == part_alignment);
    CHECK(quarter.part.download(0, 2) == std::vector{Quarter::count, Quarter::count + 1});
    quarter.part.upload(std::vector<std::uint32_t>{7, 8}, Quarter::count - 2);
    CHECK(quarter.whole.download(2 * Quarter::count - 3, 4) ==
          std::vector<std::uint32_t>{2 * Quarter::count - 3, 7, 8, 2 * Quarter::count});
    const DeviceArray<std::uint32_t> other(*test.device, std::vector<std::uint32_t>{5, 6}, "other");
    test.device->read_ahead(std::array{other.id(), quarter.part.id(), quarter.whole.id()});
    CHECK(quarter.part.download(Quarter::count - 2, 2) == std::vector<std::uint32_t>{7, 8});
    CHECK(quarter.whole.download(Quarter::count - 1, 2) == std::vector{Quarter::count - 1, Quarter::count});
    CHECK(other.download() == std::vector<std::uint32_t>{5, 6});
  }
}

TEST_CASE("parts of a buffer arrive as they were when their transfer began", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Quarter quarter(*test.device);
    const std::size_t size = sizeof(std::uint32_t);
    const auto transfer = test.device->transfer_from(quarter.part.id(), {{size, 2 * size}, {8 * size, size}});
    const auto arrived = [&] {
      while (!transfer->has_arrived()) {
      }
      std::vector<std::uint32_t> numbers(3);
      REQUIRE(transfer->bytes().size() == 3 * size);
      std::ranges::copy(transfer->bytes(), std::as_writable_bytes(std::span(numbers)).begin());
      return numbers;
    };
    const std::uint32_t first = Quarter::count;
    transfer->begin();
    quarter.part.upload(std::vector<std::uint32_t>{7, 8}, 2);
    CHECK(arrived() == std::vector{first + 1, first + 2, first + 8});
    transfer->begin();
    CHECK(arrived() == std::vector{first + 1, 7u, first + 8});
    const auto of_nothing = test.device->transfer_from(quarter.part.id(), {});
    of_nothing->begin();
    while (!of_nothing->has_arrived()) {
    }
    CHECK(of_nothing->bytes().empty());
    CHECK(test::breaks_contract([&] { test.device->transfer_from(quarter.part.id(), {{part_alignment - 1, 2}})->begin(); }));
  }
}

TEST_CASE("nobody reads, writes or divides what lies beyond a buffer or a part of one", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Quarter quarter(*test.device);
    for (const DeviceArray<std::uint32_t>* array : {&quarter.part, &quarter.whole}) {
      const BufferId buffer = array->id();
      const std::size_t size = test.device->size_of(buffer);
      const std::vector<std::byte> all(size);
      std::vector<std::byte> some(2);
      const auto writes = [&](std::size_t first, std::span<const std::byte> data) {
        return [&device = *test.device, buffer, first, data] { device.write(buffer, first, data); };
      };
      const auto reads = [&](std::size_t first) {
        return [&device = *test.device, buffer, first, &some] { device.read(buffer, first, some); };
      };
      const auto divides = [&](std::size_t first, std::size_t bytes) {
        return [&device = *test.device, buffer, first, bytes] { static_cast<void>(device.part_of(buffer, first, bytes)); };
      };
      for (const std::size_t first : {size - 1, size, size + 1, ~std::size_t{0}}) {
        CAPTURE(size, first);
        CHECK(test::breaks_contract(writes(first, some)));
        CHECK(test::breaks_contract(reads(first)));
        CHECK(test::breaks_contract(divides(first, 2)));
      }
      CHECK(test::breaks_contract(writes(1, all)));
      CHECK(test::breaks_contract(divides(size, ~std::size_t{0})));
      CHECK_NOTHROW(writes(0, all)());
      CHECK_NOTHROW(reads(size - 2)());
      CHECK_NOTHROW(divides(0, size)());
    }
    test.device->read_ahead(std::array{quarter.part.id()});
    std::vector<std::byte> some(2);
    CHECK(test::breaks_contract([&] { test.device->read(quarter.part.id(), part_alignment - 1, some); }));
  }
}

}  // namespace
}  // namespace pliant
