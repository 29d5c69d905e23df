// How many work groups of a kernel in rounds a device runs at once.
#include "collision/responses/round_kernels.hpp"

#include <bit>
#include <catch2/catch.hpp>

#include "physics/contact/surface.glsl"
#include "support/device_bench.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

TEST_CASE("as many work groups wait for each other as run at once", "[gl]") {
  if (test::lacks_gl()) return;
  const std::vector<BodySetup> setups(2, sphere(1));
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  Bench gpu(make_gpu_device(0), start, {"verlet", 0.01}, {.response = {"impulse"}});
  constexpr std::uint32_t too_many = 1u << 14;  // no device runs these at once
  const RoundKernels rounds(gpu.bodies.arrays, too_many), of_one(gpu.bodies.arrays, 0);
  const std::uint32_t groups = rounds.pass("find_flights", {}).item_count;
  CHECK((groups >= 1 && groups < too_many && std::has_single_bit(groups)));
  CHECK(rounds.pass("find_flights", {}).item_count == groups);
  CHECK(gpu.bodies.arrays.get<physics::ContactList>("contact_list").download().front().arrivals == 0);
  CHECK(of_one.pass("find_flights", {}).item_count == 1);
}

}  // namespace
}  // namespace pliant
