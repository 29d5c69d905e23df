#include "collision/contacts/touching.hpp"

#include <algorithm>

#include "collision/trees/tree_search.hpp"

namespace pliant {
namespace {

static_assert(static_cast<std::uint32_t>(TriangleTest::certified) == physics::certified_test);
static_assert(static_cast<std::uint32_t>(TriangleTest::moller) == physics::moller_test);

// tree_search.cpp says why threads must not be too few.
constexpr std::uint32_t least_test_threads = 4096, most_test_threads = 16384;

std::uint32_t largest_triangle_count(const Model& model) {
  std::uint32_t largest = 0;
  for (const ModelBody& body : model.bodies) largest = std::max(largest, body.triangle_count);
  return largest;
}

}  // namespace

Touching::Touching(DeviceBodies& bodies, const Model& model, TriangleTest test, std::uint32_t parallel_items,
                   std::uint32_t most_near_pairs)
    : bodies_(bodies),
      triangle_test_(static_cast<std::uint32_t>(test)),
      parallel_items_(parallel_items),
      most_near_pairs_(most_near_pairs),
      largest_body_(largest_triangle_count(model)) {
  bodies.arrays.make<std::uint32_t>("mark", bodies.vertex_count);
}

Parameters Touching::test_parameters(std::uint32_t half) const {
  return {{"first_position", bodies_.first_of_half(half)}, {"triangle_test", triangle_test_}};
}

Pass Touching::testing_pass(std::uint32_t half) const {
  const Device& device = bodies_.arrays.device();
  // A GPU waits for the slowest pair.
  const std::uint32_t width = device.info().kind == DeviceKind::gpu ? 4 : 1, threads = width * width;
  const std::uint32_t pairs = device.info().kind == DeviceKind::gpu
                                  ? std::clamp(parallel_items_, least_test_threads, most_test_threads) / threads
                                  : parallel_items_;
  Parameters parameters = test_parameters(half);
  parameters.insert(parameters.end(), {{"pairs_at_once", pairs}, {"test_width", width}});
  return make_pass(bodies_.arrays, "test_pairs", parameters, pairs * threads);
}

Pass Touching::brute_force_pass(std::uint32_t half) const {
  const std::uint32_t pairs = pairs_at_once(parallel_items_, largest_body_, most_near_pairs_);
  Parameters parameters = test_parameters(half);
  parameters.insert(parameters.end(), {{"threads_per_pair", largest_body_}, {"pairs_at_once", pairs}});
  return make_pass(bodies_.arrays, "test_all_pairs", parameters, pairs * largest_body_);
}

std::vector<std::uint32_t> Touching::marks() const { return bodies_.arrays.get<std::uint32_t>("mark").download(); }

void Touching::restore_marks(std::span<const std::uint32_t> marks) { bodies_.arrays.get<std::uint32_t>("mark").upload(marks); }

}  // namespace pliant
