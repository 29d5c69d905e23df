#include "collision/trees/tree_search.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

namespace pliant {
namespace {

// Only the device knows the lengths of lists, so a fixed number of threads shares them in strides. That costs less than an
// indirect dispatch, which needs a barrier in front of it: on NVIDIA 2 us against 3.3. Threads must not be too few, because
// Mesa's llvmpipe silently stops what has gone through loops 65,535 times.
constexpr std::uint32_t least_search_threads = 4096;

// Threads that hardly ever have anything to do should be few.
constexpr std::uint32_t most_unlisted_threads = 16384;

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

// Returns how many triangles a subtree has, at most, from which searches start. Subtrees of about one size make threads end
// together, whatever the sizes of bodies. They are small enough to keep the device busy if each body met another one as large,
// unless bodies are so many that whole trees do.
std::uint32_t most_triangles_of_a_start(std::uint32_t parallel_items, const Forest& forest, std::uint32_t body_count) {
  const auto subtree_pairs = [&](std::uint32_t most_triangles) {
    std::uint64_t pairs = 0;
    for (std::uint32_t body = 0; body < body_count; ++body) {
      if (forest.roots[body] == no_node) continue;
      const glm::uvec4& root = forest.nodes[forest.roots[body]];
      const std::uint64_t subtrees = (root.w - root.z - 1) / most_triangles + 1;
      pairs += subtrees * subtrees;
    }
    return pairs;
  };
  const std::uint64_t enough = std::max(std::uint64_t{4} * parallel_items, std::uint64_t{body_count});
  std::uint32_t most_triangles = 1;
  while (subtree_pairs(most_triangles) > enough) most_triangles *= 2;
  return most_triangles;
}

// Returns the array `node`. The nodes that searches start from have no parent, so that a refit ends there.
std::vector<glm::uvec4> cut_nodes(const Forest& forest, std::uint32_t most_triangles) {
  std::vector<glm::uvec4> nodes = forest.nodes, starts;
  const std::size_t first_start = forest.nodes.size() + forest.roots.size();
  for (std::uint32_t body = 0; body < forest.roots.size(); ++body) {
    const std::vector<std::uint32_t> of_body = start_nodes(forest, body, most_triangles);
    nodes.emplace_back(first_start + starts.size(), of_body.size(), 0, 0);
    for (const std::uint32_t start : of_body) {
      nodes[start].y = no_node;
      starts.emplace_back(start, 0, 0, 0);
    }
  }
  nodes.insert(nodes.end(), starts.begin(), starts.end());
  return nodes;
}

// More threads than this would have nothing to do.
std::uint32_t most_subtree_pairs(const std::vector<glm::uvec4>& nodes, const Forest& forest, std::uint32_t most_near_pairs) {
  std::uint64_t most_starts = 1;
  for (std::size_t body = 0; body < forest.roots.size(); ++body)
    most_starts = std::max<std::uint64_t>(most_starts, nodes[forest.nodes.size() + body].y);
  constexpr std::uint64_t many = 1u << 31;
  return static_cast<std::uint32_t>(std::min(many, std::min(many, most_starts * most_starts) * std::max(most_near_pairs, 1u)));
}

// Returns how many pairs there are of two leaves of different bodies.
std::uint64_t all_leaf_pairs(const Forest& forest) {
  std::uint64_t leaves = 0, pairs = 0;
  for (const std::uint32_t of_body : forest.leaf_counts) {
    pairs += leaves * of_body;
    leaves += of_body;
  }
  return pairs;
}

}  // namespace

std::uint32_t pairs_at_once(std::uint32_t parallel_items, std::uint32_t threads_per_pair, std::uint32_t most_pairs) {
  return std::clamp<std::uint32_t>(std::max(parallel_items, least_search_threads) / threads_per_pair, 1, most_pairs);
}

TreeSearch::TreeSearch(DeviceBodies& bodies, const Forest& forest, std::uint32_t leaf_pair_capacity, std::uint32_t parallel_items,
                       std::uint32_t most_near_pairs)
    : bodies_(bodies),
      leaf_count_(static_cast<std::uint32_t>(forest.leaves.size())),
      leaf_pair_capacity_(leaf_pair_capacity),
      may_lack_room_(all_leaf_pairs(forest) > leaf_pair_capacity),
      triangles_of_a_start_(most_triangles_of_a_start(parallel_items, forest, bodies.body_count)) {
  const std::vector<glm::uvec4> nodes = cut_nodes(forest, triangles_of_a_start_);
  search_threads_ = pairs_at_once(parallel_items, 1, most_subtree_pairs(nodes, forest, most_near_pairs));
  Arrays& arrays = bodies.arrays;
  arrays.set_parameter("leaf_pair_capacity", leaf_pair_capacity);
  arrays.set_parameter("node_count", static_cast<std::uint32_t>(forest.nodes.size()));
  arrays.make("tree", trees_of(forest));
  arrays.make("leaf", forest.leaves);
  arrays.make("node", nodes);
  arrays.make<glm::vec4>("node_box", 2 * forest.nodes.size());
  arrays.make("triangle", corners_of(forest));
  arrays.make<std::uint32_t>("arrival", forest.nodes.size());
  arrays.make<glm::uvec2>("leaf_pair", leaf_pair_capacity);
}

Pass TreeSearch::refitting_pass(std::uint32_t half) const {
  return make_pass(bodies_.arrays, "refit", {{"first_position", bodies_.first_of_half(half)}}, leaf_count_);
}

Pass TreeSearch::finding_pass() const {
  return make_pass(bodies_.arrays, "find_pairs", {{"search_threads", search_threads_}}, search_threads_);
}

std::vector<Pass> TreeSearch::cage_passes(std::uint32_t triangle_pair_capacity) const {
  const Device& device = bodies_.arrays.device();
  // of a pair of leaves: a GPU waits for its slowest
  const std::uint32_t threads = device.info().kind == DeviceKind::gpu ? 4 : 1;
  const std::uint32_t leaf_pairs = device.items_of_lists(bodies_.body_count) / threads;
  Pass listing = make_pass(
      bodies_.arrays, "list_triangle_pairs",
      {{"triangle_pair_capacity", triangle_pair_capacity}, {"pairs_at_once", leaf_pairs}, {"threads_of_a_pair", threads}},
      threads * leaf_pairs);
  std::vector<Pass> passes = {make_pass(bodies_.arrays, "refit_cages", {}, leaf_count_), finding_pass()};
  std::ranges::move(
      serving_passes(std::move(listing), "list_unlisted_pairs", {{"triangle_pair_capacity", triangle_pair_capacity}}),
      std::back_inserter(passes));
  return passes;
}

std::vector<Pass> TreeSearch::serving_passes(Pass of_list, std::string_view kernel_of_all, Parameters parameters) const {
  if (!may_lack_room_) return {std::move(of_list)};
  const std::uint32_t threads = std::min(search_threads_, most_unlisted_threads);
  parameters.emplace_back("search_threads", threads);
  return {beside_next(std::move(of_list)), make_pass(bodies_.arrays, kernel_of_all, parameters, threads)};
}

std::vector<glm::uvec2> TreeSearch::leaf_pairs() const {
  const std::uint32_t found = bodies_.control.download().front().leaf_pair_count;
  return bodies_.arrays.get<glm::uvec2>("leaf_pair").download(0, std::min(found, leaf_pair_capacity_));
}

std::vector<glm::vec4> TreeSearch::node_boxes() const { return bodies_.arrays.get<glm::vec4>("node_box").download(); }

}  // namespace pliant
