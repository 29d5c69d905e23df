// Arrays that no phase of a step needs together stand in the same memory, and no others do.
#include "state/shared_memory.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "device/array_list.hpp"
#include "device/cpu/cpu_device.hpp"
#include "state/arrays.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

using Catch::Contains;

TEST_CASE("arrays that share memory are written anew in each step") {
  for (const std::string_view name : sharing_arrays()) {
    CAPTURE(name);
    REQUIRE(find_array(name) != nullptr);
    CHECK(find_array(name)->life == ArrayLife::step);
    CHECK(shares_memory(name));
    CHECK_FALSE(may_overlap(name, name));
  }
  CHECK_FALSE(shares_memory("start"));
}

TEST_CASE("a kernel that names two arrays in the same memory is refused") {
  const KernelSignature::Array way{.name = "way", .array = "way"}, cut{.name = "cut", .array = "cut"},
      expected{.name = "expected", .array = "expected"};
  CHECK_NOTHROW(expect_apart(std::array{way, cut, way}));
  CHECK_THROWS_WITH(expect_apart(std::array{way, cut, expected}), Contains("way") && Contains("expected"));
}

TEST_CASE("arrays that are needed together keep what they hold, and others take no memory beside them") {
  const auto device = make_cpu_device(1, 32);
  Arrays arrays(*device);
  auto& part_sum = arrays.make<physics::PartSums>("part_sum", 3);
  arrays.make<double>("way", 1000);
  auto& way = arrays.make<double>("way", 3000);  // again, and larger
  auto& cut = arrays.make<std::uint32_t>("cut", 1000);
  const std::size_t bytes = device->allocated_bytes();
  arrays.make<double>("expected", 1000);
  arrays.make<glm::vec4>("node_box", 500);
  CHECK(device->allocated_bytes() == bytes);
  CHECK(bytes < 3 * sizeof(physics::PartSums) + 3000 * sizeof(double) + 1000 * sizeof(std::uint32_t) + 3 * part_alignment);
  way.upload(std::vector(3000, 1.5));
  cut.upload(std::vector(1000, 7u));
  physics::PartSums sums_of_part{};
  sums_of_part.cuts = 5;
  part_sum.upload(std::vector(3, sums_of_part));
  CHECK(way.download() == std::vector(3000, 1.5));
  CHECK(cut.download() == std::vector(1000, 7u));
  for (const physics::PartSums& sums : part_sum.download()) CHECK(sums.cuts == 5);
}

}  // namespace
}  // namespace pliant
