// Arrays that no phase of a step needs together stand in the same memory, and no others do. When a phase begins they may hold
// anything.
#include "state/shared_memory.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "device/array_list.hpp"
#include "device/cpu/cpu_device.hpp"
#include "state/arrays.hpp"
#include "support/collision_scene.hpp"
#include "support/device_bench.hpp"
#include "support/full_device.hpp"
#include "support/has.hpp"
#include "support/shared_phases.hpp"

namespace pliant {
namespace {

using Catch::Contains;

TEST_CASE("arrays that share memory are of those that no step leaves for the next") {
  for (const std::string_view name : sharing_arrays()) {
    CAPTURE(name);
    REQUIRE(find_array(name) != nullptr);
    CHECK(find_array(name)->life == ArrayLife::step);
    CHECK(shares_memory(name));
    CHECK_FALSE(may_overlap(name, name));
    for (const std::string_view other : sharing_arrays()) CHECK(may_overlap(name, other) == may_overlap(other, name));
  }
  CHECK_FALSE(shares_memory("start"));
}

TEST_CASE("a kernel that names two arrays in the same memory is refused") {
  const KernelSignature::Array way{.name = "way", .array = "way"}, cut{.name = "cut", .array = "cut"},
      expected{.name = "expected", .array = "expected"};
  CHECK_NOTHROW(expect_apart(std::array{way, cut, way}));
  CHECK_THROWS_WITH(expect_apart(std::array{way, cut, expected}), Contains("way") && Contains("expected"));
}

// Places of all arrays that share memory, by their names.
struct Places {
  Places(Device& on, std::mt19937& engine) : device(on), memory(on), random(engine) {
    std::vector<std::string_view> names = sharing_arrays();
    std::ranges::shuffle(names, random);
    for (const std::string_view name : names) place(name);
  }
  void place(std::string_view name) {
    sizes[name] = std::uniform_int_distribution<std::size_t>(1, 3000)(random);
    buffers[name] = memory.place(name, sizes[name]);
  }
  void fill(std::string_view name, std::byte value) {
    device.write(buffers[name], 0, std::vector(device.size_of(buffers[name]), value));
  }
  std::vector<std::byte> read(std::string_view name) {
    std::vector<std::byte> bytes(device.size_of(buffers[name]));
    device.read(buffers[name], 0, bytes);
    return bytes;
  }

  Device& device;
  SharedMemory memory;
  std::mt19937& random;
  std::map<std::string_view, BufferId> buffers;
  std::map<std::string_view, std::size_t> sizes;  // [bytes]
};

// A device ends the program if a part leaves its buffer (device_test), so all of them lie within theirs.
TEST_CASE("arrays that are needed together have no byte in common, in whatever order and how often they are placed") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 30; ++trial) {
    const auto device = make_cpu_device(1, 32);
    Places places(*device, random);
    const std::vector<std::string_view> names = sharing_arrays();
    for (int again = 0; again < trial % 6; ++again) places.place(names[random() % names.size()]);
    for (const std::string_view name : names) {
      CAPTURE(trial, name);
      CHECK(device->size_of(places.buffers[name]) == places.sizes[name]);
      places.fill(name, std::byte{1});
      for (const std::string_view other : names)
        if (other != name && !may_overlap(name, other)) places.fill(other, std::byte{2});
      CHECK(places.read(name) == std::vector(places.sizes[name], std::byte{1}));
    }
  }
}

// What one array is needed with is a phase here: one that is needed in several is needed alone in all but one of them.
TEST_CASE("shared memory is as large as the phase that needs the most") {
  std::mt19937 random(12);
  for (int trial = 0; trial < 30; ++trial) {
    CAPTURE(trial);
    const auto device = make_cpu_device(1, 32);
    const Places places(*device, random);
    std::size_t most = 0;
    for (const std::string_view name : sharing_arrays()) {
      std::size_t together = 0;
      for (const std::string_view other : sharing_arrays())
        if (!may_overlap(name, other))
          together += (places.sizes.at(other) + part_alignment - 1) / part_alignment * part_alignment;
      most = std::max(most, together);
    }
    CHECK(device->allocated_bytes() == most);
  }
}

TEST_CASE("where memory can't grow, arrays that share it keep their places") {
  test::FullDevice device(make_cpu_device(1, 32));
  Arrays arrays(device);
  auto& way = arrays.make<double>("way", 3000);
  device.refuse_beyond(3000 * sizeof(double));
  CHECK_THROWS_AS(arrays.make<double>("way", 6000), Error);
  way.upload(std::vector(3000, 1.5));
  CHECK_THROWS_AS(arrays.make<std::uint32_t>("cut", 1000), Error);  // both are needed at once, and there is no room
  CHECK(way.download() == std::vector(3000, 1.5));
}

TEST_CASE("arrays that share memory take none beside each other's") {
  const auto device = make_cpu_device(1, 32);
  Arrays arrays(*device);
  const auto& way = arrays.make<double>("way", 3000);
  auto& cut = arrays.make<std::uint32_t>("cut", 1000);
  const std::size_t bytes = device->allocated_bytes();
  CHECK(bytes < 3000 * sizeof(double) + 1000 * sizeof(std::uint32_t) + 2 * part_alignment);
  auto& expected = arrays.make<double>("expected", 3000);
  CHECK(device->allocated_bytes() == bytes);
  expected.upload(std::vector(3000, 1.5));
  CHECK(way.download() == std::vector(3000, 1.5));
  cut.upload(std::vector(1000, 7u));
  CHECK(way.download() == std::vector(3000, 1.5));
}

// A scene whose steps are made twice: undisturbed, and with rubbish in shared memory.
struct Rubbish {
  const char* name;
  ModelAndState start;
  Method method;
  CollisionDescription collision;
  std::optional<double> tolerance;
  int steps;
};

std::vector<BodySetup> inflated_spheres() {
  std::vector<BodySetup> setups = colliding_spheres();
  setups[0].description.restitution = 0.5;
  setups[1].description.pressure = 3;
  return setups;
}

// Two at rest, of which one gets hit.
std::vector<BodySetup> spheres_into_others_at_rest() {
  std::vector<BodySetup> setups = colliding_spheres();
  setups[1].description.velocity = {0, 0, 0};
  setups.push_back(setups[1]);
  setups[2].description.position = {3.12, -0.1, 0.05};
  setups.push_back(setups[1]);
  setups[3].description.position = {0, 9, 0};
  return setups;
}

std::vector<Rubbish> rubbish_scenes() {
  GroundDescription ground;
  ground.point = {0, -0.93, 0};
  BodySetup plate = sphere(0);
  plate.description.kind = BodyKind::immovable;
  plate.description.position = {-1.05, 1.98, 0};
  std::vector<BodySetup> with_plate = inflated_spheres();
  with_plate.push_back(plate);
  const glm::dvec3 downward(0, -1, 0), nowhere(0.0);
  const ModelAndState above_ground = build_model(with_plate, downward, {&ground, 1}),
                      apart = build_model(inflated_spheres(), nowhere),
                      at_rest = build_model(spheres_into_others_at_rest(), nowhere);
  ModelAndState clustered = above_ground;
  for (ModelBody& body : clustered.model.bodies) {
    body.is_clustered = !body.is_rigid();
    body.force_tolerance = 0.01;  // so that clusters see nodes of others
  }
  const CollisionDescription impulse{.response = {"impulse"}}, reflect{.response = {"reflect"}};
  const Method verlet{"verlet", 0.01, DampingLaw::internal}, stages{"rk4", 0.01, DampingLaw::internal},
      adaptive{"dop853", 0.04, DampingLaw::internal}, undamped{"verlet", 0.01, DampingLaw::none};
  return {{"impulses by a splitting", above_ground, verlet, impulse, {}, 14},
          {"impulses by stages", above_ground, stages, impulse, {}, 12},
          {"impulses on clustered bodies, by a splitting", clustered, verlet, impulse, {}, 14},
          {"impulses on clustered bodies, by stages", clustered, stages, impulse, {}, 12},
          {"impulses with a tolerance", above_ground, adaptive, impulse, 1e-6, 30},
          {"impulses on bodies at rest", at_rest, undamped, impulse, {}, 20},
          {"reflections", apart, verlet, reflect, {}, 14},
          {"reflections with a tolerance", apart, adaptive, reflect, 1e-6, 30},
          {"reflections of bodies at rest", at_rest, undamped, reflect, {}, 20}};
}

// All that steps leave for later ones.
std::map<std::string, std::vector<std::byte>> all_carried_by(const Bench& bench) {
  std::map<std::string, std::vector<std::byte>> carried;
  for (const CarriedArray& array : bench.bodies.arrays.carried()) {
    carried[array.name].resize(array.byte_count);
    bench.device->read(array.buffer, array.first_byte, carried[array.name]);
  }
  return carried;
}

std::unique_ptr<Bench> bench_of(std::unique_ptr<Device> device, const Rubbish& scene) {
  if (scene.tolerance)
    return std::make_unique<Bench>(std::move(device), scene.start, scene.method, scene.collision, *scene.tolerance);
  return std::make_unique<Bench>(std::move(device), scene.start, scene.method, scene.collision);
}

// Makes steps, and disturbs shared memory when each of them begins and when each of its phases does. Adds to `seen` which arrays
// kernels name.
void run_in_rubbish(Bench& bench, int steps, std::set<std::string>& seen) {
  constexpr std::byte rubbish{0xff};  // numbers are not finite, and counts are large
  SharedPhases phases;
  bench.begin();
  for (int step = 0; step < steps; ++step) {
    fill_shared_memory(bench.bodies.arrays, rubbish);
    for (const Pass& pass : bench.step(static_cast<std::uint32_t>(step & 1))) {
      const KernelSignature& signature = bench.device->signature(pass.call.kernel);
      if (phases.begins_with(signature)) fill_shared_memory(bench.bodies.arrays, rubbish);
      for (const KernelSignature::Array& array : signature.arrays) seen.insert(array.array);
      bench.device->run({&pass, 1});
    }
  }
}

void run_undisturbed(Bench& bench, int steps) {
  bench.begin();
  for (int step = 0; step < steps; ++step) bench.device->run(bench.step(static_cast<std::uint32_t>(step & 1)));
}

void check_scene_in_rubbish(const Rubbish& scene, std::unique_ptr<Device> (*make_device)(), std::set<std::string>& seen) {
  CAPTURE(scene.name);
  std::map<std::string, std::vector<std::byte>> undisturbed;
  {
    const auto bench = bench_of(make_device(), scene);
    run_undisturbed(*bench, scene.steps);
    undisturbed = all_carried_by(*bench);
    const physics::Control control = bench->bodies.control.download().front();
    CHECK(control.contact_steps > 0);
    CHECK(control.non_finite_step == 0);
    std::uint32_t at_rest = 0;
    for (const physics::Tally& tally : bench->bodies.tallies.download()) at_rest += tally.steps_at_rest;
    if (std::string_view(scene.name).ends_with("at rest")) CHECK(at_rest > 0);
  }
  const auto bench = bench_of(make_device(), scene);
  if (scene.start.model.bodies.front().is_clustered)
    CHECK(bench->device->size_of(bench->bodies.arrays.buffer("node_pull")) > physics::pull_row_size * sizeof(double));
  run_in_rubbish(*bench, scene.steps, seen);
  for (const auto& [name, bytes] : all_carried_by(*bench)) {
    CAPTURE(name);
    CHECK((bytes == undisturbed.at(name)));
  }
}

void check_all_in_rubbish(std::unique_ptr<Device> (*make_device)()) {
  std::set<std::string> seen;
  for (const Rubbish& scene : rubbish_scenes()) check_scene_in_rubbish(scene, make_device, seen);
  for (const std::string_view name : sharing_arrays()) {
    CAPTURE(name);
    const bool is_of_quiet_steps = name == "quiet_body" || name == "kept_before";  // quiet_steps_test has rubbish, too
    CHECK(seen.contains(std::string(name)) == !is_of_quiet_steps);
  }
}

TEST_CASE("what stands in shared memory when a phase begins changes no bit") {
  check_all_in_rubbish([] { return make_cpu_device(2, 32); });
}

TEST_CASE("what stands in shared memory when a phase begins changes no bit on a GPU", "[gl]") {
  if (test::lacks_gl()) return;
  check_all_in_rubbish([] { return make_gpu_device(0); });
}

}  // namespace
}  // namespace pliant
