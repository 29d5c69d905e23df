// Passes find their arrays and parameters by name, and say which is wrong.
#include "state/arrays.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "core/read_text.hpp"
#include "gl/shader_source.hpp"
#include "support/collision_scene.hpp"
#include "support/has.hpp"
#include "support/own_rows.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

using Catch::Contains;

std::string row_in_docs(const ArrayRow& row) {
  constexpr std::string_view lives[] = {"fixed", "carried", "step"};
  return "| `" + std::string(row.name) + "` | " + std::string(row.element) + " | " + std::string(row.per) + " | " +
         std::string(lives[static_cast<std::size_t>(row.life)]) + " | " + std::string(row.layout) + " |\n";
}

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  constexpr std::string_view folder = "compute/kernels/", suffix = ".glsl";
  for (const gl::ShaderFile& file : gl::embedded_shaders())
    if (file.name.starts_with(folder) && file.name.find('/', folder.size()) == std::string_view::npos)
      names.emplace_back(file.name.substr(folder.size(), file.name.size() - folder.size() - suffix.size()));
  return names;
}

TEST_CASE("docs/conventions.md repeats the list of arrays") {
  const std::string text = read_text(source_dir() + "/docs/conventions.md");
  const std::size_t begin = text.find("| array | element |"), end = text.find("\n\n", begin);
  std::string expected = "| array | element | per | life | layout |\n|---|---|---|---|---|\n";
  for (const ArrayRow& row : array_list()) expected += row_in_docs(row);
  CHECK(text.substr(begin, end + 1 - begin) == expected);
}

TEST_CASE("an array that nobody has made is named, with the kernel that reads it") {
  const auto device = make_cpu_device(1, 32);
  Arrays arrays(*device);
  arrays.make<physics::Control>("control", 1);
  CHECK_THROWS_WITH(make_pass(arrays, "judge_step", {}, 1), Contains("judge_step") && Contains("pace"));
  CHECK_THROWS_WITH(arrays.carry_part("pace", 0, 8), Contains("pace"));
  arrays.make<physics::Pace>("pace", 1);
  CHECK_NOTHROW(make_pass(arrays, "judge_step", {}, 1));
}

TEST_CASE("an array has the elements of the list and no others") {
  const auto device = make_cpu_device(1, 32);
  Arrays arrays(*device);
  CHECK_THROWS_WITH(arrays.make<double>("mark", 3), Contains("mark") && Contains("uint") && Contains("double"));
  CHECK_THROWS_WITH(arrays.make<double>("no_such_array", 3), Contains("no_such_array"));
  arrays.make<std::uint32_t>("mark", 3);
  CHECK_THROWS_WITH(arrays.get<double>("mark"), Contains("mark"));
}

TEST_CASE("a view of an array has numbers of the array's type", "[gl]") {
  add_misread_kernel();  // before devices, which know the kernels of their time
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
    const DeviceBodies bodies(*test.device, start.model, start.state);
    CHECK_THROWS_WITH(make_pass(bodies.arrays, "misread", {}, 1),
                      Contains("misread") && Contains("motion") && Contains("double") && Contains("vec4"));
    const KernelSignature& reads_four = test.device->signature(test.device->kernel("sum_volume"));
    const auto view = std::ranges::find(reads_four.arrays, "placement", &KernelSignature::Array::array);
    REQUIRE(view != reads_four.arrays.end());
    CHECK(view->view == "real4");  // of numbers `real`, which pressure records
  }
}

TEST_CASE("parameters go by name, and each has the kernel's type") {
  const auto device = make_cpu_device(1, 32);
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  DeviceBodies bodies(*device, start.model, start.state);
  bodies.arrays.make<double>("kept_force", 3 * start.model.vertex_count());
  bodies.arrays.make<std::uint32_t>("mark", start.model.vertex_count());
  bodies.make_placements(physics::slots_of_stages);
  bodies.arrays.set_parameter("keeps_force", 1u);
  const auto record = [&](Parameters parameters) { return make_pass(bodies.arrays, "reflect", parameters, 1); };
  CHECK_NOTHROW(record({{"elasticity", 0.9}, {"from_half", 0u}}));
  CHECK(record({{"elasticity", 0.9}, {"from_half", 1u}}).call.parameters ==
        record({{"from_half", 1u}, {"elasticity", 0.9}}).call.parameters);
  CHECK_THROWS_WITH(record({{"elasticity", 0.9}}), Contains("reflect") && Contains("from_half"));
  CHECK_THROWS_WITH(record({{"elasticity", 1u}, {"from_half", 0u}}), Contains("elasticity") && Contains("double"));
  CHECK_THROWS_WITH(record({{"elasticity", 0.9}, {"from_half", 0u}, {"friction", 0.5}}), Contains("friction"));
}

TEST_CASE("bodies start moving, finite and, until their vertices are placed, undeformed") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(1, 32);
  const DeviceBodies bodies(*device, start.model, start.state);
  CHECK(bodies.statuses.size() == start.model.bodies.size() + 1);
  for (const physics::Status& status : bodies.statuses.download())
    CHECK((status.activity == physics::moving && status.non_finite_vertex == physics::no_vertex && status.deformed == 0));
}

TEST_CASE("every kernel declares the same arrays and parameters on CPU and GPU", "[gl]") {
  if (test::lacks_gl()) return;
  const auto cpu = make_cpu_device(1, 32), gpu = make_gpu_device(0);
  const auto names = kernel_names();
  CHECK(names.size() > 20);
  for (const std::string& name : names) {
    CAPTURE(name);
    const bool is_of_forces = name.ends_with("_stage") || name == "refresh_force" || name == "sum_springs";
    constexpr std::string_view in_rounds[] = {"solve_contacts",  "certify",      "certify_self_contact", "pay_dues",
                                              "restore_impacts", "find_flights", "find_sleepers"};
    constexpr std::string_view in_groups[] = {
        "refit",          "refit_cages",         "bound_treelets",      "bound_cage_treelets",
        "find_pairs",     "test_unlisted_pairs", "list_unlisted_pairs", "sum_leaf_moments",
        "sum_moments",    "find_rigid_motion",   "place_nodes",         "sum_leaf_springs",
        "sum_node_pulls", "share_pulls"};
    const bool goes_in_groups = std::ranges::find(in_groups, name) != std::end(in_groups);
    const bool goes_in_rounds = std::ranges::find(in_rounds, name) != std::end(in_rounds);
    for (const bool sums_are_given : {true, false}) {
      if (sums_are_given ? name == "sum_springs" : !is_of_forces) continue;
      const auto variant_of = [&](const Device& device) {
        return sums_are_given ? device.force_variants().size() : fastest_force_variant(device.force_variants(), 1000, 1000);
      };
      const auto signature = [&](Device& device) {
        if (goes_in_groups) return device.signature(device.group_kernel(name, physics::group_size));
        if (goes_in_rounds) return device.signature(device.round_kernel(name));
        return device.signature(is_of_forces ? device.force_kernel(name, variant_of(device)) : device.kernel(name));
      };
      const KernelSignature on_cpu = signature(*cpu), on_gpu = signature(*gpu);
      const auto described = [](const KernelSignature::Array& array) {
        constexpr std::string_view uses[] = {"reads", "writes", "has as constants"};
        return std::string(uses[static_cast<std::size_t>(array.use)]) + " " + array.array + " " + array.view;
      };
      std::vector<std::string> cpu_arrays, gpu_arrays, cpu_numbers, gpu_numbers;
      for (const auto& array : on_cpu.arrays)
        if (array.array != "spring_sum" || array.use == ArrayUse::write || sums_are_given) cpu_arrays.push_back(described(array));
      for (const auto& array : on_gpu.arrays)
        if (array.array != "meeting" || !is_of_forces) gpu_arrays.push_back(described(array));  // for all stages at once alone
      if (is_of_forces)  // all stages at once write through the view, too
        std::ranges::replace(gpu_arrays, std::string("writes placement real4"), std::string("reads placement real4"));
      for (const auto& number : on_cpu.parameters) cpu_numbers.push_back(number.name + (number.is_double ? " double" : ""));
      for (const auto& number : on_gpu.parameters)
        if (number.name != "item_count" && number.name != "is_rehearsal")
          gpu_numbers.push_back(number.name + (number.is_double ? " double" : ""));
      if (is_of_forces)
        for (auto* list : {&cpu_arrays, &gpu_arrays}) std::ranges::sort(*list);
      std::ranges::sort(cpu_numbers);
      std::ranges::sort(gpu_numbers);
      CHECK(cpu_arrays == gpu_arrays);
      CHECK(cpu_numbers == gpu_numbers);
      CHECK(on_gpu.arrays.size() <= max_arrays);
      CHECK_NOTHROW(expect_apart(on_gpu.arrays));
    }
  }
}

}  // namespace
}  // namespace pliant
