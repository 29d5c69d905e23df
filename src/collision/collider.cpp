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

std::vector<std::uint32_t> corners_of(const Forest& forest) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : forest.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
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

Collider::Collider(DeviceBodies& bodies, const Model& model, const CollisionDescription& description,
                   std::optional<std::uint32_t> parallel_items)
    : bodies_(bodies),
      description_(description),
      forest_(build_forest(model, model.rest_positions, description.tree)),
      parallel_items_(parallel_items.value_or(bodies.arrays.device().parallel_items())),
      start_depth_(start_depth_for(parallel_items_, forest_, bodies.body_count)),
      largest_body_(largest_triangle_count(model)),
      most_near_pairs_(std::max(bodies.body_count * (bodies.body_count - 1) / 2, 1u)) {
  Arrays& arrays = bodies.arrays;
  arrays.make("tree", trees_of(forest_));
  arrays.make("leaf", forest_.leaves);
  arrays.make("node", cut_nodes(forest_, start_depth_));
  arrays.make<glm::vec4>("node_box", 2 * forest_.nodes.size());
  arrays.make("triangle", corners_of(forest_));
  arrays.make<std::uint32_t>("arrival", forest_.nodes.size());
  arrays.make<std::uint32_t>("partner_step", bodies.body_count);
  arrays.make<glm::uvec2>("near_pair", most_near_pairs_);
  arrays.make<glm::uvec2>("leaf_pair", leaf_pair_capacity);
  arrays.make<std::uint32_t>("mark", bodies.vertex_count);
}

bool Collider::uses_trees() const {
  return description_.search == ContactSearch::tree && bodies_.body_count > 1 && !forest_.leaves.empty();
}

std::vector<Pass> Collider::bounding_passes(std::uint32_t half) const {
  return {make_pass(bodies_.arrays, "bound_bodies", {{"first_position", half * bodies_.vertex_count}}, bodies_.vertex_count)};
}

std::vector<Pass> Collider::contact_passes(std::uint32_t half) const {
  const DeviceBodies& b = bodies_;
  if (b.body_count < 2 || forest_.leaves.empty()) return {};
  std::vector<Pass> result = {make_pass(b.arrays, "pair_bodies", {}, b.body_count * b.body_count)};
  const std::uint32_t first_position = half * b.vertex_count;
  const auto search =
      description_.search == ContactSearch::tree ? tree_passes(first_position) : brute_force_passes(first_position);
  result.insert(result.end(), search.begin(), search.end());
  return result;
}

std::uint32_t Collider::pairs_at_once(std::uint32_t threads_per_pair) const {
  return std::clamp<std::uint32_t>(std::max(parallel_items_, least_threads) / threads_per_pair, 1, most_near_pairs_);
}

std::vector<Pass> Collider::tree_passes(std::uint32_t first_position) const {
  const auto test = static_cast<std::uint32_t>(description_.triangle_test);
  const auto capacity = static_cast<std::uint32_t>(leaf_pair_capacity);
  const std::uint32_t starts = 1u << start_depth_;
  const std::uint32_t pairs = pairs_at_once(starts * starts);
  const std::uint32_t tests_at_once =
      std::clamp(parallel_items_, least_threads, most_test_threads) / physics::threads_per_leaf_pair;
  return {
      make_pass(bodies_.arrays, "refit", {{"first_position", first_position}}, static_cast<std::uint32_t>(forest_.leaves.size())),
      make_pass(bodies_.arrays, "find_pairs",
                {{"first_position", first_position},
                 {"triangle_test", test},
                 {"leaf_pair_capacity", capacity},
                 {"first_start", static_cast<std::uint32_t>(forest_.nodes.size())},
                 {"start_count", starts},
                 {"pairs_at_once", pairs}},
                pairs * starts * starts),
      make_pass(bodies_.arrays, "test_pairs",
                {{"first_position", first_position},
                 {"triangle_test", test},
                 {"leaf_pair_capacity", capacity},
                 {"pairs_at_once", tests_at_once}},
                tests_at_once * physics::threads_per_leaf_pair)};
}

std::vector<Pass> Collider::brute_force_passes(std::uint32_t first_position) const {
  const std::uint32_t pairs = pairs_at_once(largest_body_);
  return {make_pass(bodies_.arrays, "test_all_pairs",
                    {{"first_position", first_position},
                     {"triangle_test", static_cast<std::uint32_t>(description_.triangle_test)},
                     {"threads_per_pair", largest_body_},
                     {"pairs_at_once", pairs}},
                    pairs * largest_body_)};
}

std::vector<Pass> Collider::response_passes(std::uint32_t from_half) const {
  if (bodies_.body_count < 2 || forest_.leaves.empty()) return {};
  return {make_pass(bodies_.arrays, "respond", {{"from_half", from_half}, {"elasticity", description_.elasticity}},
                    bodies_.vertex_count)};
}

std::vector<glm::uvec2> Collider::leaf_pairs() const {
  const std::uint32_t found = bodies_.control.download().front().leaf_pair_count;
  return bodies_.arrays.get<glm::uvec2>("leaf_pair").download(0, std::min<std::size_t>(found, leaf_pair_capacity));
}

std::vector<glm::vec4> Collider::node_boxes() const { return bodies_.arrays.get<glm::vec4>("node_box").download(); }

std::vector<std::uint32_t> Collider::marks() const { return bodies_.arrays.get<std::uint32_t>("mark").download(); }

void Collider::restore_marks(std::span<const std::uint32_t> marks) { bodies_.arrays.get<std::uint32_t>("mark").upload(marks); }

}  // namespace pliant
