// Every kernel on the GPU against the same kernel on the CPU, pass by pass, from the same input.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <regex>
#include <set>

#include "gl/context.hpp"
#include "gl/shader_source.hpp"
#include "support/collision_scene.hpp"

namespace pliant {
namespace {

struct Slot {
  std::size_t index;
  std::string type;
};

// The buffers that a kernel writes, from its own declarations.
std::vector<Slot> written_slots(std::string_view kernel) {
  const std::string name = "compute/kernels/" + std::string(kernel) + ".glsl";
  for (const gl::ShaderFile& file : gl::embedded_shaders()) {
    if (file.name != name) continue;
    const std::string text(file.text);
    const std::regex declaration(R"(WRITE\((\d), \w+, +(\w+), \w+\))");
    std::vector<Slot> slots;
    for (std::sregex_iterator match(text.begin(), text.end(), declaration), end; match != end; ++match)
      slots.push_back({std::stoul((*match)[1]), (*match)[2]});
    return slots;
  }
  FAIL("no kernel " << kernel);
  return {};
}

// A whole simulation's passes on one device, with its objects kept alive.
struct Bench {
  Bench(std::unique_ptr<Device> on, const ModelAndState& start, const Method& method, const CollisionDescription& collision)
      : device(std::move(on)),
        bodies(*device, start.model, start.state),
        stepper(*device, bodies, find_integrator(method.integrator), method.law, method.time_step),
        collider(*device, bodies, start.model, collision) {}

  std::vector<Pass> step(std::uint32_t from_half) {
    std::vector<Pass> passes = stepper.passes(from_half);
    for (const auto& more :
         {collider.bounding_passes(1 - from_half), collider.contact_passes(1 - from_half), collider.response_passes(from_half)})
      passes.insert(passes.end(), more.begin(), more.end());
    passes.push_back(make_pass(*device, "finish_step", {bodies.control.id()}, {}, 1));
    return passes;
  }

  template <class T>
  std::vector<T> read(BufferId buffer) {
    std::vector<T> values(device->size_of(buffer) / sizeof(T));
    device->read(buffer, 0, std::as_writable_bytes(std::span<T>(values)));
    return values;
  }

  // Whether the pass, were it next, would run any item.
  bool has_work(const Pass& pass) {
    if (pass.group_counts == 0) return pass.item_count > 0;
    std::uint32_t groups = 0;
    device->read(pass.group_counts, pass.group_counts_byte, std::as_writable_bytes(std::span(&groups, 1)));
    return groups > 0;
  }

  std::unique_ptr<Device> device;
  DeviceBodies bodies;
  Stepper stepper;
  Collider collider;
};

template <class T>
double largest_difference(const std::vector<T>& a, const std::vector<T>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0, scale = 1e-30;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = larger(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    scale = std::max(scale, std::abs(static_cast<double>(b[i])));
  }
  return largest / scale;
}

std::vector<double> numbers_of(const physics::Frame& frame) {
  std::vector<double> numbers(offsetof(physics::Frame, turned) / sizeof(double));
  std::memcpy(numbers.data(), &frame, numbers.size() * sizeof(double));
  for (const std::uint32_t flag : {frame.turned, frame.deformed, frame.force_stale, frame.refresh_force, frame.force_evaluations,
                                   frame.forces_skipped, frame.halted})
    numbers.push_back(flag);
  return numbers;
}

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

// What a pass has written, compared as its type asks. Lists filled in any order are compared as sets.
void check_same(Bench& cpu, Bench& gpu, const Pass& cpu_pass, const Pass& gpu_pass) {
  for (const Slot& slot : written_slots(cpu_pass.name)) {
    CAPTURE(cpu_pass.name, slot.index, slot.type);
    const BufferId a = cpu_pass.call.buffers[slot.index], b = gpu_pass.call.buffers[slot.index];
    if (slot.type == "Control") {
      const auto x = cpu.read<std::uint32_t>(a), y = gpu.read<std::uint32_t>(b);
      CHECK(std::equal(x.begin(), x.begin() + sizeof(physics::Control) / 4, y.begin()));
    } else if (slot.type == "Frame") {
      const auto x = cpu.read<physics::Frame>(a), y = gpu.read<physics::Frame>(b);
      for (std::size_t f = 0; f < cpu.bodies.body_count; ++f)
        CHECK(largest_difference(numbers_of(y[f]), numbers_of(x[f])) < 1e-13);
    } else if (slot.type == "double") {
      const auto [x, y] = read_both<double>(cpu, gpu, a, b);
      CHECK(largest_difference(y, x) < 1e-6);
    } else if (slot.type == "uvec2") {
      const physics::Control control = cpu.bodies.control.download().front();
      const std::uint32_t count = cpu_pass.name == "pair_bodies" ? control.near_pair_count : control.candidate_count;
      CHECK(as_set(gpu.read<glm::uvec2>(b), count) == as_set(cpu.read<glm::uvec2>(a), count));
    } else if (slot.type == "uint") {
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
  for (const Slot& slot : written_slots(from_pass.name)) {
    const auto bytes = from.read<std::byte>(from_pass.call.buffers[slot.index]);
    const BufferId target = to_pass.call.buffers[slot.index];
    to.device->write(target, 0, std::span(bytes).first(std::min(bytes.size(), to.device->size_of(target))));
  }
}

void compare_steps(const Method& method, const CollisionDescription& collision, std::set<std::string_view>& seen) {
  const ModelAndState start = build_model(colliding_spheres(), {0, -1, 0});
  Bench cpu(make_cpu_device(2, 32), start, method, collision), gpu(make_gpu_device(0), start, method, collision);
  for (std::uint32_t step = 0; step < 12; ++step) {
    CAPTURE(method.integrator, step);
    const auto cpu_passes = cpu.step(step & 1), gpu_passes = gpu.step(step & 1);
    REQUIRE(cpu_passes.size() == gpu_passes.size());
    for (std::size_t k = 0; k < cpu_passes.size(); ++k) {
      if (cpu.has_work(cpu_passes[k])) seen.insert(cpu_passes[k].name);
      run_passes(*cpu.device, std::span(&cpu_passes[k], 1));
      run_passes(*gpu.device, std::span(&gpu_passes[k], 1));
      check_same(cpu, gpu, cpu_passes[k], gpu_passes[k]);
      copy_state(cpu, gpu, cpu_passes[k], gpu_passes[k]);
    }
  }
  CHECK(cpu.bodies.control.download().front().contact_steps > 0);
}

TEST_CASE("each kernel computes on the GPU what it computes on the CPU", "[gl]") {
  if (gl::list_adapters().empty()) return;
  std::set<std::string_view> seen;
  CollisionDescription tree, brute;
  brute.search = ContactSearch::brute_force;
  brute.triangle_test = TriangleTest::moller;
  compare_steps({"cv8", 0.01, DampingLaw::adaptive}, tree, seen);
  compare_steps({"verlet", 0.01, DampingLaw::constant}, brute, seen);
  std::size_t kernel_count = 0;
  for (const gl::ShaderFile& file : gl::embedded_shaders())
    if (file.name.starts_with("compute/kernels/") && file.name.find("/parts/") == std::string_view::npos) ++kernel_count;
  CHECK(seen.size() == kernel_count);
}

TEST_CASE("boxes of trees are the same bits on CPU and GPU, and bound their triangles", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const Method method{"rk4", 0.01};
  std::vector<std::unique_ptr<Bench>> benches;
  benches.push_back(std::make_unique<Bench>(make_cpu_device(3, 32), start, method, CollisionDescription{}));
  if (!gl::list_adapters().empty())
    benches.push_back(std::make_unique<Bench>(make_gpu_device(0), start, method, CollisionDescription{}));
  // The same world positions everywhere, close enough for the trees to be refitted.
  std::vector<glm::vec4> positions;
  for (const glm::dvec3& p : start.state.world_positions(start.model)) positions.emplace_back(glm::vec3(p), 1.0f);
  for (std::size_t i = start.model.bodies[1].first_vertex; i < positions.size(); ++i) positions[i].x -= 0.3f;
  for (const auto& bench : benches) {
    bench->bodies.world_positions.upload(positions, positions.size());
    for (const auto& passes :
         {std::vector{bench->step(0)[0]}, bench->collider.bounding_passes(1), bench->collider.contact_passes(1)})
      run_passes(*bench->device, passes);
    const Forest& forest = bench->collider.forest();
    const auto boxes = bench->collider.node_boxes();
    std::size_t wrong = 0;
    for (std::size_t n = 0; n < forest.nodes.size(); ++n) {
      glm::vec3 lower(1e30f), upper(-1e30f);
      for (std::uint32_t t = forest.nodes[n].z; t < forest.nodes[n].w; ++t)
        for (const std::uint32_t vertex : forest.triangles[t]) {
          lower = glm::min(lower, glm::vec3(positions[vertex]));
          upper = glm::max(upper, glm::vec3(positions[vertex]));
        }
      if (glm::vec3(boxes[2 * n]) != lower || glm::vec3(boxes[2 * n + 1]) != upper) ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(bench->bodies.control.download().front().count[physics::nodes_refitted] == forest.nodes.size());
  }
}

}  // namespace
}  // namespace pliant
