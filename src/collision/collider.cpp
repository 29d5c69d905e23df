// pair bodies -> refit the trees of those that are near -> find pairs of leaves -> test them -> respond.
#include "collision/collider.hpp"

#include <algorithm>
#include <bit>

namespace pliant {
namespace {

static_assert(static_cast<std::uint32_t>(TriangleTest::certified) == physics::certified_test);
static_assert(static_cast<std::uint32_t>(TriangleTest::moller) == physics::moller_test);

// A full list costs speed, never a contact: the thread that finds a pair then tests it itself.
constexpr std::size_t leaf_pair_capacity = std::size_t{1} << 18;

// Lists have lengths that the device alone knows, so a fixed number of threads shares them in strides. That costs less than an
// indirect dispatch: on NVIDIA 2 us against 3.3, for the barrier in front of it. Not too few threads: Mesa's llvmpipe breaks off,
// without a word, what has gone through loops 65,535 times.
constexpr std::uint32_t least_threads = 4096, most_test_threads = 16384;

std::vector<glm::uvec2> trees_of(const Forest& forest) {
  std::vector<glm::uvec2> trees;
  for (std::size_t body = 0; body < forest.roots.size(); ++body) trees.emplace_back(forest.roots[body], forest.leaf_counts[body]);
  return trees;
}

std::span<const std::uint32_t> corners_of(const Forest& forest) {
  return {forest.triangles.empty() ? nullptr : forest.triangles.front().data(), 3 * forest.triangles.size()};
}

std::uint32_t largest_triangle_count(const Model& model) {
  std::uint32_t largest = 0;
  for (const ModelBody& body : model.bodies) largest = std::max(largest, body.triangle_count);
  return largest;
}

// A search starts from pairs of nodes at one depth of both trees, as many as keep the device busy, and needs nothing above it.
unsigned start_depth_for(std::uint32_t parallel_items, const Forest& forest, std::uint32_t body_count) {
  const std::uint32_t pairs = std::clamp<std::uint32_t>(body_count * (body_count - 1) / 2, 1, 16);
  const auto depth = static_cast<unsigned>(std::bit_width(std::max(parallel_items / pairs, 1u)) - 1) / 2;
  return std::min(depth, forest.depth);
}

// The forest's nodes, cut off above the nodes that searches start from; behind them those nodes' indices.
std::vector<glm::uvec4> cut_nodes(const Forest& forest, unsigned start_depth) {
  std::vector<glm::uvec4> nodes = forest.nodes;
  for (std::uint32_t body = 0; body < forest.roots.size(); ++body)
    for (const std::uint32_t start : start_nodes(forest, body, start_depth)) {
      if (start != no_node) nodes[start].y = no_node;
      nodes.emplace_back(start, 0, 0, 0);
    }
  return nodes;
}

}  // namespace

Collider::Collider(Device& device, DeviceBodies& bodies, const Model& model, const CollisionDescription& description,
                   std::optional<std::uint32_t> parallel_items)
    : device_(device),
      bodies_(bodies),
      description_(description),
      forest_(build_forest(model, model.rest_positions, description.tree)),
      parallel_items_(parallel_items.value_or(device.parallel_items())),
      start_depth_(start_depth_for(parallel_items_, forest_, bodies.body_count)),
      largest_body_(largest_triangle_count(model)),
      trees_(device, trees_of(forest_), "trees"),
      leaves_(device, forest_.leaves, "tree leaves"),
      nodes_(device, cut_nodes(forest_, start_depth_), "tree nodes"),
      node_boxes_(device, 2 * forest_.nodes.size(), "tree boxes"),
      triangles_(device, corners_of(forest_), "triangles"),
      arrivals_(device, forest_.nodes.size(), "tree arrivals"),
      partner_steps_(device, bodies.body_count, "partner steps"),
      near_pairs_(device, std::size_t{bodies.body_count} * (bodies.body_count - 1) / 2, "near pairs"),
      leaf_pairs_(device, leaf_pair_capacity, "pairs of leaves"),
      marks_(device, bodies.vertex_count, "contact marks") {}

bool Collider::uses_trees() const {
  return description_.search == ContactSearch::tree && bodies_.body_count > 1 && !forest_.leaves.empty();
}

std::vector<Pass> Collider::bounding_passes(std::uint32_t half) const {
  const DeviceBodies& b = bodies_;
  return {make_pass(device_, "bound_bodies", {b.frames.id(), b.rest_positions.id(), b.world_positions.id()},
                    {half * b.vertex_count}, b.vertex_count)};
}

std::vector<Pass> Collider::contact_passes(std::uint32_t half) const {
  const DeviceBodies& b = bodies_;
  if (b.body_count < 2 || forest_.leaves.empty()) return {};
  std::vector<Pass> result = {make_pass(device_, "pair_bodies",
                                        {b.control.id(), trees_.id(), b.frames.id(), near_pairs_.id(), partner_steps_.id()},
                                        {b.body_count}, b.body_count * b.body_count)};
  const std::uint32_t first_position = half * b.vertex_count;
  const auto search =
      description_.search == ContactSearch::tree ? tree_passes(first_position) : brute_force_passes(first_position);
  result.insert(result.end(), search.begin(), search.end());
  return result;
}

std::uint32_t Collider::pairs_at_once(std::uint32_t threads_per_pair) const {
  return std::clamp<std::uint32_t>(std::max(parallel_items_, least_threads) / threads_per_pair, 1,
                                   static_cast<std::uint32_t>(near_pairs_.size()));
}

std::vector<Pass> Collider::tree_passes(std::uint32_t first_position) const {
  const DeviceBodies& b = bodies_;
  const auto test = static_cast<std::uint32_t>(description_.triangle_test);
  const auto capacity = static_cast<std::uint32_t>(leaf_pairs_.size());
  const std::uint32_t starts = 1u << start_depth_;
  const std::uint32_t pairs = pairs_at_once(starts * starts);
  const std::uint32_t tests_at_once =
      std::clamp(parallel_items_, least_threads, most_test_threads) / physics::threads_per_leaf_pair;
  return {make_pass(device_, "refit",
                    {b.control.id(), leaves_.id(), nodes_.id(), node_boxes_.id(), triangles_.id(), b.world_positions.id(),
                     arrivals_.id(), partner_steps_.id()},
                    {first_position}, static_cast<std::uint32_t>(forest_.leaves.size())),
          make_pass(device_, "find_pairs",
                    {b.control.id(), near_pairs_.id(), nodes_.id(), node_boxes_.id(), triangles_.id(), b.world_positions.id(),
                     leaf_pairs_.id(), marks_.id()},
                    {first_position, test, capacity, static_cast<std::uint32_t>(forest_.nodes.size()), starts, pairs},
                    pairs * starts * starts),
          make_pass(device_, "test_pairs",
                    {b.control.id(), leaf_pairs_.id(), nodes_.id(), triangles_.id(), b.world_positions.id(), marks_.id()},
                    {first_position, test, capacity, tests_at_once}, tests_at_once * physics::threads_per_leaf_pair)};
}

std::vector<Pass> Collider::brute_force_passes(std::uint32_t first_position) const {
  const DeviceBodies& b = bodies_;
  const std::uint32_t pairs = pairs_at_once(largest_body_);
  return {make_pass(
      device_, "test_all_pairs",
      {b.control.id(), near_pairs_.id(), nodes_.id(), triangles_.id(), b.world_positions.id(), marks_.id(), trees_.id()},
      {first_position, static_cast<std::uint32_t>(description_.triangle_test), largest_body_, pairs}, pairs * largest_body_)};
}

std::vector<Pass> Collider::response_passes(std::uint32_t from_half) const {
  const DeviceBodies& b = bodies_;
  if (b.body_count < 2 || forest_.leaves.empty()) return {};
  return {make_pass(device_, "respond",
                    {b.control.id(), b.bodies.id(), b.frames.id(), b.rest_positions.id(), marks_.id(), b.placements.id(),
                     b.motions.id(), b.world_positions.id()},
                    {b.vertex_count, from_half, description_.elasticity}, b.vertex_count)};
}

std::vector<glm::uvec2> Collider::leaf_pairs() const {
  const std::uint32_t found = bodies_.control.download().front().leaf_pair_count;
  return leaf_pairs_.download(0, std::min<std::size_t>(found, leaf_pairs_.size()));
}

}  // namespace pliant
