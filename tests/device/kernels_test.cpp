// Every kernel on the GPU against the same kernel on the CPU, pass by pass, from the same input.
#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "bench/common/shapes.hpp"
#include "device/array_list.hpp"
#include "dynamics/clusters/cluster_forces.hpp"
#include "gl/context.hpp"
#include "gl/shader_source.hpp"
#include "mesh/generators.hpp"
#include "physics/contact/exact_sum.glsl"
#include "ranks/ranks.hpp"
#include "support/collision_scene.hpp"
#include "support/device_bench.hpp"
#include "support/has.hpp"
#include "support/largest_difference.hpp"
#include "support/own_rows.hpp"
#include "support/shared_phases.hpp"
#include "support/struct_numbers.hpp"

namespace pliant {
namespace {

std::multiset<std::pair<std::uint32_t, std::uint32_t>> as_set(const std::vector<glm::uvec2>& pairs, std::size_t count) {
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> set;
  for (std::size_t i = 0; i < count; ++i) set.emplace(pairs[i].x, pairs[i].y);
  return set;
}

// The two devices' contents of a buffer. The CPU rounds a buffer's size up.
template <class T>
std::pair<std::vector<T>, std::vector<T>> read_both(Bench& cpu, Bench& gpu, BufferId a, BufferId b) {
  std::pair<std::vector<T>, std::vector<T>> values{cpu.read<T>(a), gpu.read<T>(b)};
  REQUIRE(values.first.size() >= values.second.size());
  values.first.resize(values.second.size());
  return values;
}

// An array that a pass writes, with the type of its elements.
struct Written {
  std::string_view name, element;
  BufferId on_cpu, on_gpu;
};

BufferId buffer_of(const Bench& bench, const Pass& pass, std::string_view array) {
  const auto& declared = bench.device->signature(pass.call.kernel).arrays;
  for (std::size_t k = 0; k < declared.size(); ++k)
    if (declared[k].array == array) return pass.call.buffers[k];
  FAIL(pass.name << " does not declare " << array);
  return 0;
}

// What a pass writes, by the declarations of the kernel's file and of all that it includes.
std::vector<Written> written_arrays(const Bench& cpu, const Bench& gpu, const Pass& cpu_pass, const Pass& gpu_pass) {
  std::set<std::string> names;
  for (const auto& array : cpu.device->signature(cpu_pass.call.kernel).arrays)
    if (array.use == ArrayUse::write) names.insert(array.array);
  std::vector<Written> written;
  for (const std::string& name : names)
    written.push_back(
        {find_array(name)->name, find_array(name)->element, buffer_of(cpu, cpu_pass, name), buffer_of(gpu, gpu_pass, name)});
  return written;
}

template <class T>
void check_structs(Bench& cpu, Bench& gpu, BufferId a, BufferId b, std::size_t count, double tolerance) {
  const auto x = cpu.read<T>(a), y = gpu.read<T>(b);
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double> on_cpu = numbers_of(x[k]), on_gpu = numbers_of(y[k]);
    CAPTURE(k, on_cpu, on_gpu);
    CHECK(largest_difference(on_gpu, on_cpu) < tolerance);
  }
}

// Contacts with their numbers, by their vertices, because lists are in no fixed order.
std::map<std::array<std::uint32_t, 4>, std::vector<double>> contacts_of(Bench& bench) {
  const Arrays& arrays = bench.bodies.arrays;
  const std::uint32_t count = contact_count(bench);
  const auto vertices = arrays.get<glm::uvec4>("contact_vertex").download(0, count);
  const auto rows = bench.read<float>(arrays.buffer("contact")), impulses = bench.read<float>(arrays.buffer("contact_impulse"));
  std::map<std::array<std::uint32_t, 4>, std::vector<double>> contacts;
  for (std::uint32_t c = 0; c < count; ++c) {
    std::vector<double>& numbers = contacts[{vertices[c].x, vertices[c].y, vertices[c].z, vertices[c].w}];
    const auto first = rows.begin() + 4 * physics::contact_rows * c;
    numbers.assign(first, first + 12);
    numbers.insert(numbers.end(), impulses.begin() + 4 * c, impulses.begin() + 4 * (c + 1));
  }
  return contacts;
}

// What a step has kept of the last one's contacts, in the same way.
std::map<std::array<std::uint32_t, 4>, std::vector<double>> kept_by(Bench& bench) {
  const Arrays& arrays = bench.bodies.arrays;
  const std::uint32_t count = arrays.get<physics::ContactList>("contact_list").download().front().latest_count;
  const auto vertices = arrays.get<glm::uvec4>("kept_key").download(0, count);
  const auto impulses = bench.read<float>(arrays.buffer("kept_impulse"));
  std::map<std::array<std::uint32_t, 4>, std::vector<double>> kept;
  for (std::uint32_t c = 0; c < count; ++c)
    if (vertices[c].x != physics::no_vertex)
      kept[{vertices[c].x, vertices[c].y, vertices[c].z, vertices[c].w}].assign(impulses.begin() + 4 * c,
                                                                                impulses.begin() + 4 * (c + 1));
  return kept;
}

void check_same_kept(Bench& cpu, Bench& gpu) {
  const auto on_cpu = kept_by(cpu), on_gpu = kept_by(gpu);
  REQUIRE(on_gpu.size() == on_cpu.size());
  for (const auto& [vertices, numbers] : on_cpu) {
    const auto found = on_gpu.find(vertices);
    REQUIRE(found != on_gpu.end());
    CHECK(largest_difference(found->second, numbers) < 1e-4);
  }
}

void check_same_contacts(Bench& cpu, Bench& gpu) {
  const auto on_cpu = contacts_of(cpu), on_gpu = contacts_of(gpu);
  REQUIRE(on_gpu.size() == on_cpu.size());
  for (const auto& [vertices, numbers] : on_cpu) {
    const auto found = on_gpu.find(vertices);
    REQUIRE(found != on_gpu.end());
    CHECK(largest_difference(found->second, numbers) < 1e-4);
  }
}

std::vector<double> whole_numbers_of(const std::vector<glm::uvec2>& halves) {
  std::vector<double> numbers;
  for (const glm::uvec2& sum : halves) numbers.push_back(physics::whole_of(sum));
  return numbers;
}

template <class T>
std::vector<double> float_numbers_of(const std::vector<T>& bits) {
  std::vector<double> numbers;
  for (const T number : bits) numbers.push_back(double(std::bit_cast<float>(number)));
  return numbers;
}

// Compares an array of contacts by impulses. Returns whether it is one.
bool check_impulses(Bench& cpu, Bench& gpu, const Written& written) {
  const auto& [name, element, a, b] = written;
  if (name == "contact_list") {
    check_structs<physics::ContactList>(cpu, gpu, a, b, 1, 1e-6);
  } else if (name == "step_parts") {
    check_structs<physics::StepParts>(cpu, gpu, a, b, 1, 1e-13);
  } else if (name == "debt") {
    check_structs<physics::Debt>(cpu, gpu, a, b, cpu.bodies.body_count + 1, 1e-9);
  } else if (name == "cluster") {
    check_structs<physics::Cluster>(cpu, gpu, a, b, cpu.bodies.body_count + 1, 1e-6);
  } else if (name == "triangle_pair") {
    const auto count = cpu.bodies.arrays.get<physics::ContactList>("contact_list").download().front().triangle_pair_count;
    CHECK(as_set(gpu.read<glm::uvec2>(b), count) == as_set(cpu.read<glm::uvec2>(a), count));
  } else if (name == "contact_vertex" || name == "contact" || name == "contact_impulse") {
    check_same_contacts(cpu, gpu);
  } else if (name == "kept_slot" || name == "kept_key" || name == "kept_impulse") {
    check_same_kept(cpu, gpu);
  } else if (name == "impulse_sum" || name == "contact_sum" || name == "impact_sum" || name == "island_sum") {
    const auto [x, y] = read_both<glm::uvec2>(cpu, gpu, a, b);
    CHECK(largest_difference(whole_numbers_of(y), whole_numbers_of(x)) < 1e-4);
  } else if (name == "contact_weight") {
    const auto [x, y] = read_both<std::uint32_t>(cpu, gpu, a, b);
    CHECK(largest_difference(y, x) < 1e-4);
  } else if (name == "cut") {
    const auto [x, y] = read_both<std::uint32_t>(cpu, gpu, a, b);
    CHECK(largest_difference(float_numbers_of(y), float_numbers_of(x)) < 1e-4);
  } else {
    return false;
  }
  return true;
}

// Compares what a pass has written on both devices, as its type asks. Lists filled in any order are compared as sets.
void check_same(Bench& cpu, Bench& gpu, const Pass& cpu_pass, const Pass& gpu_pass) {
  for (const Written& written : written_arrays(cpu, gpu, cpu_pass, gpu_pass)) {
    const auto& [name, element, a, b] = written;
    CAPTURE(cpu_pass.name, name);
    if (cpu_pass.name == "solve_contacts" && name == "impulse_sum" && contact_count(cpu) <= 512) continue;  // of one work group
    if (check_impulses(cpu, gpu, written)) continue;
    if (element == "Control") {
      check_structs<physics::Control>(cpu, gpu, a, b, 1, 1e-13);
    } else if (element == "Pose") {
      check_structs<physics::Pose>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-13);
    } else if (element == "FrameChange") {
      check_structs<physics::FrameChange>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-13);
    } else if (element == "BoxBits") {
      check_structs<physics::BoxBits>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-6);
    } else if (element == "QuietSteps") {
      check_structs<physics::QuietSteps>(cpu, gpu, a, b, 1, 1e-13);
    } else if (element == "QuietBody") {
      check_structs<physics::QuietBody>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-6);
    } else if (element == "Room") {
      check_structs<physics::Room>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-6);
    } else if (element == "Status") {
      check_structs<physics::Status>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-13);
    } else if (element == "GridEntry") {
      check_structs<physics::GridEntry>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-6);
    } else if (name == "grid_list") {  // which body of a list comes first depends on threads
      const auto [x, y] = read_both<std::uint32_t>(cpu, gpu, a, b);
      CHECK(std::ranges::equal(
          x, y, {}, [](std::uint32_t first) { return first != 0; }, [](std::uint32_t first) { return first != 0; }));
    } else if (element == "Tally") {
      check_structs<physics::Tally>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-13);
    } else if (element == "Moments") {
      check_structs<physics::Moments>(cpu, gpu, a, b, cpu.bodies.arrays.get<physics::Moments>(name).size(), 1e-12);
    } else if (element == "PartSums") {
      check_structs<physics::PartSums>(cpu, gpu, a, b, cpu.bodies.arrays.get<physics::PartSums>(name).size(), 1e-9);
    } else if (element == "RigidMotion") {
      check_structs<physics::RigidMotion>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-12);
    } else if (element == "Pace") {
      const auto x = numbers_of(cpu.read<physics::Pace>(a).front()), y = numbers_of(gpu.read<physics::Pace>(b).front());
      constexpr std::size_t allowed = offsetof(physics::Pace, allowed) / sizeof(double);  // it comes from powers of floats
      for (std::size_t k = 0; k < x.size(); ++k)
        CHECK(y[k] == Approx(x[k]).epsilon(cpu_pass.name == "judge_step" && k != allowed ? 1e-12 : 1e-6));
    } else if (element == "PathState") {
      check_structs<physics::PathState>(cpu, gpu, a, b, cpu.bodies.body_count, 1e-13);
    } else if (element == "Aim") {
      const auto x = cpu.read<physics::Aim>(a).front(), y = gpu.read<physics::Aim>(b).front();
      for (int k = 0; k < 3; ++k) CHECK(std::abs(y.change[k] - x.change[k]) < 1e-6 * x.largest_speed);
    } else if (element == "double") {  // what pulls a cluster's nodes is a difference of two sums that are nearly as large
      const auto [x, y] = read_both<double>(cpu, gpu, a, b);
      CHECK(largest_difference(y, x) < (name == "cluster_pull" ? 1e-3 : 1e-6));
    } else if (element == "uvec2") {
      const physics::Control control = cpu.bodies.control.download().front();
      const std::uint32_t count = name == "treelet_pair" ? control.treelet_pair_count : control.leaf_pair_count;
      CHECK(as_set(gpu.read<glm::uvec2>(b), count) == as_set(cpu.read<glm::uvec2>(a), count));
    } else if (element == "uint") {
      const auto [x, y] = read_both<std::uint32_t>(cpu, gpu, a, b);
      CHECK(x == y);
    } else {
      const auto [x, y] = read_both<float>(cpu, gpu, a, b);
      CHECK(largest_difference(y, x) < 1e-6);
    }
  }
}

// Gives the GPU the CPU's bits after each pass, so that rounding does not add up from pass to pass.
void copy_state(Bench& from, Bench& to, const Pass& from_pass, const Pass& to_pass) {
  for (const auto& [name, element, source, target] : written_arrays(from, to, from_pass, to_pass)) {
    const auto bytes = from.read<std::byte>(source);
    to.device->write(target, 0, std::span(bytes).first(std::min(bytes.size(), to.device->size_of(target))));
  }
}

// Arrays that share memory may hold anything when a phase begins. They are emptied then, because what a pass leaves as it is gets
// compared, too.
void compare_pass(Bench& cpu, Bench& gpu, SharedPhases& phases, const Pass& cpu_pass, const Pass& gpu_pass) {
  if (phases.begins_with(cpu.device->signature(cpu_pass.call.kernel)))
    for (Bench* bench : {&cpu, &gpu}) fill_shared_memory(bench->bodies.arrays, std::byte{0});
  cpu.device->run({&cpu_pass, 1});
  gpu.device->run({&gpu_pass, 1});
  check_same(cpu, gpu, cpu_pass, gpu_pass);
  copy_state(cpu, gpu, cpu_pass, gpu_pass);
}

void compare_passes(Bench& cpu, Bench& gpu, SharedPhases& phases, const std::vector<Pass>& cpu_passes,
                    const std::vector<Pass>& gpu_passes, std::set<std::string_view>& seen) {
  REQUIRE(cpu_passes.size() == gpu_passes.size());
  for (std::size_t k = 0; k < cpu_passes.size(); ++k) {
    compare_pass(cpu, gpu, phases, cpu_passes[k], gpu_passes[k]);
    seen.insert(cpu_passes[k].name);
  }
}

void compare_steps(Bench& cpu, Bench& gpu, std::uint32_t steps, std::set<std::string_view>& seen) {
  SharedPhases phases;
  for (const auto& [on_cpu, on_gpu] :
       {std::pair{cpu.stepper.first_passes(), gpu.stepper.first_passes()},
        {std::vector{cpu.collider.bounding_pass(0)}, std::vector{gpu.collider.bounding_pass(0)}}}) {
    compare_pass(cpu, gpu, phases, on_cpu.front(), on_gpu.front());
    seen.insert(on_cpu.front().name);
  }
  cpu.bodies.prepare_search();
  gpu.bodies.prepare_search();
  for (std::uint32_t step = 0; step < steps; ++step) {
    CAPTURE(step);
    compare_passes(cpu, gpu, phases, cpu.pulled_step(step & 1), gpu.pulled_step(step & 1), seen);
  }
  CHECK(cpu.bodies.control.download().front().contact_steps > 0);
}

// What stands around quiet steps, behind a whole step. The steps between are left out.
void compare_quiet_passes(std::set<std::string_view>& seen) {
  std::vector<BodySetup> setups(2, sphere(1));
  setups[0].description.velocity = {-1, 0, 0};
  setups[1].description.position = {20, 0, 0};
  GroundDescription ground;
  ground.point = {0, -12, 0};
  const ModelAndState start = build_model(setups, {0, -1, 0}, {&ground, 1});
  const CollisionDescription impulses{.response = {"impulse"}};
  Bench cpu(make_cpu_device(2, 32), start, {"verlet", 0.01}, impulses),
      gpu(make_gpu_device(0), start, {"verlet", 0.01}, impulses);
  const physics::QuietSteps asked{.end = 5, .undone = ~0u, .arrivals = 0, .begun = 1, .moving_shares = 0};
  for (Bench* bench : {&cpu, &gpu}) {
    bench->bodies.arrays.make("quiet_steps", std::vector{asked});
    bench->bodies.arrays.make<physics::QuietBody>("quiet_body", 2);
    bench->begin();
    bench->device->run(bench->step(0));
  }
  const auto passes_of = [](const Bench& bench) {
    std::vector<Pass> passes = {make_pass(bench.bodies.arrays, "list_moving_shares", {{"most_shares", 2u}},
                                          static_cast<std::uint32_t>(bench.bodies.shares().size()))};
    std::ranges::copy(bench.collider.response()->before_quiet_steps(1), std::back_inserter(passes));
    passes.push_back(make_pass(bench.bodies.arrays, "end_quiet_steps", {{"pair_count", 1u}}, 2));
    passes.push_back(bench.collider.bounding_pass(1));
    passes.push_back(make_pass(bench.bodies.arrays, "give_room", {{"from_half", 1u}, {"searches", 1u}}, 2));
    std::ranges::copy(bench.collider.response()->after_quiet_steps(), std::back_inserter(passes));
    return passes;
  };
  SharedPhases phases;
  compare_passes(cpu, gpu, phases, passes_of(cpu), passes_of(gpu), seen);
  CHECK(cpu.bodies.control.download().front().step == 7);
  for (Bench* bench : {&cpu, &gpu}) {
    DeviceArray<physics::QuietSteps>& steps = bench->bodies.arrays.get<physics::QuietSteps>("quiet_steps");
    steps.upload(std::span(&asked, 1));
    const Pass lists = make_pass(bench->bodies.arrays, "list_moving_shares", {{"most_shares", 1u}}, 2);
    bench->device->run({&lists, 1});
    CHECK(steps.download().front().moving_shares == 2);
    CHECK(steps.download().front().end == 0);
  }
}

// Springs of a clustered body, and what a check measures of them.
void compare_cluster_passes(std::set<std::string_view>& seen) {
  const ModelAndState start = bench::deformed_body(generate_mesh("icosphere:3"));
  const Method method{"verlet", 0.01};
  const CollisionDescription none{.response = {"none"}};
  Bench cpu(make_cpu_device(2, 32), start, method, none), gpu(make_gpu_device(0), start, method, none);
  const auto passes_of = [&](Bench& bench) {
    std::vector<Pass> passes = bench.stepper.first_passes();
    ClusterTrees trees(2);
    const ClusterForces forces(bench.bodies, start.model, std::vector{std::optional(ListBasis{1e-7})}, trees);
    std::ranges::copy(forces.measuring_passes(physics::start_slot), std::back_inserter(passes));
    return passes;
  };
  const std::vector<Pass> on_cpu = passes_of(cpu), on_gpu = passes_of(gpu);
  for (std::size_t k = 0; k < on_cpu.size(); ++k) copy_state(cpu, gpu, on_cpu[k], on_gpu[k]);  // new arrays may hold anything
  SharedPhases phases;
  compare_passes(cpu, gpu, phases, on_cpu, on_gpu, seen);
}

// One of two ranks, of whom the other does nothing.
class HalfOfTwo final : public Ranks {
 public:
  std::size_t number() const override { return 0; }
  std::size_t count() const override { return 2; }
  std::size_t number_here() const override { return 0; }
  std::size_t count_here() const override { return 2; }
  void take_from_first(std::span<std::byte>) override {}
  std::vector<std::uint64_t> hear_all(std::uint64_t mine) override { return {mine, mine}; }
  void begin_sharing(std::span<double>, std::span<const NumberRange>) override {}
  void go_on() override {}
  void end_sharing() override {}
  void agree_to_end() override {}
};

// Springs of the first of two alike bodies. Of those, however devices cut them, a rank has one.
void compare_shared_passes(std::set<std::string_view>& seen) {
  std::vector<BodySetup> setups{sphere(2), sphere(2)};
  for (BodySetup& setup : setups) setup.description.stretch = {0.8, 1.1, 1};
  setups[1].description.position = {5, 0, 0};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const Method method{"verlet", 0.01};
  const CollisionDescription none{.response = {"none"}};
  HalfOfTwo ranks;
  const auto joined = [&](std::unique_ptr<Device> device) {
    device->join(&ranks);
    return device;
  };
  Bench cpu(joined(make_cpu_device(2, 32)), start, method, none), gpu(joined(make_gpu_device(0)), start, method, none);
  const auto passes_of = [](Bench& bench) {
    std::vector<Pass> passes = bench.stepper.first_passes();
    for (const Pass& pass : bench.stepper.passes(0))
      if (pass.name == "sum_springs") passes.push_back(pass);
    return passes;
  };
  SharedPhases phases;
  compare_passes(cpu, gpu, phases, passes_of(cpu), passes_of(gpu), seen);
}

std::uint32_t frame_changes(const Bench& bench) {
  std::uint32_t changes = 0;
  for (const physics::Tally& tally : bench.bodies.tallies.download()) changes += tally.frame_changes;
  return changes;
}

TEST_CASE("each kernel computes on the GPU what it computes on the CPU", "[gl]") {
  if (test::lacks_gl()) return;
  add_own_rows();
  std::set<std::string_view> seen;
  CollisionDescription tree{.response = {"reflect"}}, brute = tree, grid = tree;
  grid.broad_phase = BroadPhase::grid;
  grid.tree.refit = TreeRefit::hybrid;
  grid.leaf_pair_capacity = 2000;  // there are more pairs of leaves, but fewer overlap
  brute.search = ContactSearch::brute_force;
  brute.triangle_test = TriangleTest::moller;
  std::vector<BodySetup> setups = colliding_spheres();
  const double stiffness = setups.back().description.stiffness;
  for (const ForceExample& example : force_examples()) example.set(setups.back().description);  // it feels all forces at once
  setups.back().description.stiffness = stiffness;
  setups.front().description.restitution = 0.5;
  setups.front().description.self_contact = true;
  BodySetup plate = sphere(0);
  plate.description.name = "plate";
  plate.description.kind = BodyKind::immovable;
  plate.description.position = {-1.05, 1.98, 0};
  ModelAndState start = build_model(setups, {0, -1, 0});
  for (const Force& force : forces()) {
    CAPTURE(force.name);
    REQUIRE(feels(start.model.bodies.back(), force));
  }
  setups.push_back(plate);
  BodySetup ring = body_of_mesh(generate_mesh("ring:0.3,8"));  // is no star, so its tree is compared with itself
  ring.description.name = "ring";
  ring.description.self_contact = true;
  ring.description.position = {0, 8, 0};
  ring.description.stretch = {1.1, 1, 1};
  setups.push_back(ring);
  BodySetup paddle = sphere(0);
  paddle.description.name = "paddle";
  paddle.description.kind = BodyKind::scripted;
  paddle.description.position = {2.9, 0.2, 0};
  paddle.description.velocity = {-1, 0, 0};
  paddle.description.spin = {0, 0, 2};
  setups.push_back(paddle);
  GroundDescription ground;
  ground.point = {0, -0.93, 0};
  start = build_model(setups, {0, -1, 0}, {&ground, 1});
  for (const ResponseRow& response : responses())
    for (auto [method, collision] : {std::pair<Method, CollisionDescription>{{"cv8", 0.01, DampingLaw::adaptive}, tree},
                                     {{"verlet", 0.01, DampingLaw::constant}, brute},
                                     {{"verlet", 0.01, DampingLaw::internal}, grid},
                                     {{"rk4", 0.01, DampingLaw::internal}, tree}}) {
      CAPTURE(response.name, method.integrator);
      collision.response = Named{std::string(response.name)};
      Bench cpu(make_cpu_device(2, 32), start, method, collision), gpu(make_gpu_device(0), start, method, collision);
      compare_steps(cpu, gpu, 12, seen);
      CHECK(frame_changes(cpu) > 0);
      if (response.name == "reflect") CHECK(cpu.bodies.control.download().front().total_low[physics::reverted_vertices] > 0);
    }
  for (BodySetup& setup : setups) setup.description.self_contact = false;
  const ModelAndState without = build_model(setups, {0, -1, 0}, {&ground, 1});
  const CollisionDescription impulses{.response = {"impulse"}};
  Bench cpu_without(make_cpu_device(2, 32), without, {"verlet", 0.01}, impulses),
      gpu_without(make_gpu_device(0), without, {"verlet", 0.01}, impulses);
  compare_steps(cpu_without, gpu_without, 3, seen);
  std::uint32_t rejected_for_error = 0, rejected_in_contact = 0;
  for (const char* integrator : {"dop853", "vern8"}) {
    CAPTURE(integrator);
    const Method method{integrator, 0.04, DampingLaw::adaptive};
    Bench cpu(make_cpu_device(2, 32), start, method, tree, 1e-6), gpu(make_gpu_device(0), start, method, tree, 1e-6);
    compare_steps(cpu, gpu, 40, seen);
    CHECK(frame_changes(cpu) > 0);
    const physics::Pace pace = cpu.pacer->pace();
    CHECK((pace.accepted > 0 && pace.verdict == physics::step_empty));
    rejected_in_contact += pace.rejected_in_contact;
    rejected_for_error += pace.rejected - pace.rejected_in_contact;
  }
  CHECK((rejected_for_error > 0 && rejected_in_contact > 0));
  compare_quiet_passes(seen);
  compare_cluster_passes(seen);
  compare_shared_passes(seen);
  std::size_t kernel_count = own_kernel_files().size();
  for (const gl::ShaderFile& file : gl::embedded_shaders())
    if (file.name.starts_with("compute/kernels/") && file.name.find("/parts/") == std::string_view::npos) ++kernel_count;
  CHECK(seen.size() == kernel_count);
}

// One work group serves up to 512 contacts alone. These are 441 and 529. A group with 32 KB of memory has no room for 441
// vertices.
TEST_CASE("many contacts at once get the impulses on the GPU that they get on the CPU", "[gl]") {
  if (test::lacks_gl()) return;
  const int cells = GENERATE(20, 22);
  CAPTURE(cells);
  BodySetup cube = sphere(0);
  cube.mesh = generate_mesh(fmt::format("cube:{}", cells));
  cube.description.velocity = {0.3, -1, 0};
  const double lowest = std::ranges::min(cube.mesh.positions, {}, &glm::dvec3::y).y + cube.description.position.y;
  GroundDescription ground;
  ground.point = {0, lowest - 1e-3, 0};
  const ModelAndState start = build_model(std::vector{cube}, {0, -1, 0}, {&ground, 1});
  const Method method{"verlet", 1e-3, DampingLaw::none};
  const CollisionDescription impulse{.response = {"impulse"}};
  Bench cpu(make_cpu_device(2, 32), start, method, impulse), gpu(make_gpu_device(0), start, method, impulse);
  std::set<std::string_view> seen;
  compare_steps(cpu, gpu, 2, seen);
  const auto bottom = static_cast<std::uint32_t>((cells + 1) * (cells + 1));
  CHECK(cpu.bodies.control.download().front().contact_pairs_max == bottom);
}

}  // namespace
}  // namespace pliant
