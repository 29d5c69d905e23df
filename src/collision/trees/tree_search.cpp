#include "collision/trees/tree_search.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace pliant {
namespace {

// Only the device knows the lengths of lists, so a fixed number of threads shares them in strides. That costs less than an
// indirect dispatch, which needs a barrier in front of it: on NVIDIA 2 us against 3.3. Threads must not be too few, because
// Mesa's llvmpipe silently stops what has gone through loops 65,535 times.
constexpr std::uint32_t least_search_threads = 4096;

// Groups are as many as keep the device busy, since those with nothing to do take time, too. Those that hardly ever have anything
// to do should be few.
constexpr std::uint32_t most_unlisted_groups = 1024;
std::uint32_t most_groups_of(std::uint32_t parallel_items) { return std::clamp(parallel_items / 16, 256u, 4096u); }

constexpr std::uint32_t least_triangles_of_a_treelet = 16;

// Of a group that refits a treelet. A thread waits for memory at each node, so it should have few. Treelets count by their nodes,
// so that one large body has its threads among many small ones.
std::uint32_t threads_of_a_refit(const Treelets& treelets) {
  constexpr std::uint64_t nodes_of_a_thread = 4, most_threads = 512;
  std::uint64_t squares = 0;
  for (const physics::Treelet& t : treelets.treelets)
    squares += std::uint64_t{t.end_node - t.first_node} * (t.end_node - t.first_node);
  const std::uint64_t nodes = squares / std::max<std::size_t>(treelets.nodes.size(), 1);
  return static_cast<std::uint32_t>(
      std::bit_floor(std::clamp<std::uint64_t>(nodes / nodes_of_a_thread, physics::group_size, most_threads)));
}

std::vector<std::uint32_t> corners_of(const Forest& forest) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : forest.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

// Returns how many triangles a treelet has, at most. There are enough of them to keep the device busy if each body met another
// one as large, unless bodies are so many that whole trees do. Smaller treelets leave less to refit, but make more pairs. As many
// pairs as a quarter of the triangles is a good compromise.
std::uint32_t most_triangles_of_a_treelet(std::uint32_t parallel_items, const Forest& forest) {
  const auto treelet_pairs = [&](std::uint32_t most_triangles) {
    std::uint64_t pairs = 0;
    for (const std::uint32_t root : forest.roots) {
      if (root == no_node) continue;
      const std::uint64_t treelets = roots_of_treelets(forest, root, most_triangles).size();
      pairs += treelets * treelets;
    }
    return pairs;
  };
  const std::uint64_t enough = std::max<std::uint64_t>({parallel_items, forest.triangles.size() / 4, forest.roots.size()});
  std::uint32_t most_triangles = least_triangles_of_a_treelet;
  while (treelet_pairs(most_triangles) > enough) most_triangles *= 2;
  return most_triangles;
}

// Returns how many pairs of treelets there may be to look at.
std::uint32_t most_treelet_pairs(const Treelets& treelets, std::uint32_t most_near_pairs) {
  std::uint64_t most_treelets = 1;
  for (const glm::uvec4& tree : treelets.trees) most_treelets = std::max<std::uint64_t>(most_treelets, tree.y);
  constexpr std::uint64_t many = 1u << 31;
  return static_cast<std::uint32_t>(
      std::min(many, std::min(many, most_treelets * most_treelets) * std::max(most_near_pairs, 1u)));
}

TreeRefit default_refit(DeviceKind device) { return device == DeviceKind::gpu ? TreeRefit::bottom_up : TreeRefit::hybrid; }

// Returns how many pairs of leaves a search may find: of different bodies, and of one that meets itself.
std::uint64_t all_leaf_pairs(const Forest& forest) {
  std::uint64_t leaves = 0, pairs = 0, of_body = 0;
  std::size_t body = forest.roots.size();
  for (std::size_t n = forest.nodes.size(); n-- > 0;) {
    of_body += forest.nodes[n].is_leaf() ? 1 : 0;
    if (forest.nodes[n].parent != no_node) continue;
    do --body;
    while (forest.roots[body] != n);
    pairs += leaves * of_body + (forest.self_contact[body] ? of_body * (of_body + 1) / 2 : 0);
    leaves += std::exchange(of_body, 0);
  }
  return pairs;
}

}  // namespace

std::uint32_t pairs_at_once(std::uint32_t parallel_items, std::uint32_t threads_per_pair, std::uint32_t most_pairs) {
  return std::clamp<std::uint32_t>(std::max(parallel_items, least_search_threads) / threads_per_pair, 1, most_pairs);
}

TreeSearch::TreeSearch(DeviceBodies& bodies, const Forest& forest, const CollisionDescription& description,
                       std::uint32_t parallel_items, std::uint32_t most_near_pairs)
    : bodies_(bodies),
      leaf_pair_capacity_(description.leaf_pair_capacity),
      may_lack_room_(all_leaf_pairs(forest) > description.leaf_pair_capacity),
      triangles_of_a_treelet_(most_triangles_of_a_treelet(parallel_items, forest)) {
  const Device& device = bodies.arrays.device();
  Treelets treelets = cut_into_treelets(forest, triangles_of_a_treelet_);
  treelet_count_ = static_cast<std::uint32_t>(treelets.treelets.size());
  // If each tree is one treelet, all that a search needs is known beforehand.
  is_hybrid_ = description.tree.refit.value_or(default_refit(device.info().kind)) == TreeRefit::hybrid &&
               std::ranges::any_of(treelets.trees, [](const glm::uvec4& tree) { return tree.y > 1; });
  const std::uint32_t treelet_pairs = is_hybrid_ ? description.treelet_pair_capacity : 0;
  const std::uint32_t most = most_treelet_pairs(treelets, most_near_pairs);
  const std::uint32_t pairs_of_a_group = device.info().kind == DeviceKind::gpu ? 32 : 1;  // 16 and 64 take an H200 as long
  search_groups_ = std::clamp(most / pairs_of_a_group, 1u, most_groups_of(parallel_items));
  pairing_threads_ =
      device.info().kind == DeviceKind::gpu ? pairs_at_once(parallel_items, 1, most) : std::min(parallel_items, most);
  threads_of_a_refit_ = threads_of_a_refit(treelets);
  Arrays& arrays = bodies.arrays;
  arrays.set_parameter("leaf_pair_capacity", leaf_pair_capacity_);
  arrays.set_parameter("treelet_pair_capacity", treelet_pairs);
  arrays.make("tree", treelets.trees);
  arrays.make("treelet", treelets.treelets);
  arrays.make("node", treelets.nodes);
  arrays.make<glm::vec4>("node_box", 2 * treelets.nodes.size());
  arrays.make("triangle", corners_of(forest));
  arrays.make<glm::uvec2>("leaf_pair", leaf_pair_capacity_);
  arrays.make("treelet_vertex", is_hybrid_ ? treelets.vertices : std::vector<std::uint32_t>(1));
  arrays.make<glm::uvec2>("treelet_pair", std::max(treelet_pairs, 1u));
  arrays.make<std::uint32_t>("treelet_step", is_hybrid_ ? treelet_count_ : 1);
  in_forest_ = std::move(treelets.in_forest);
}

Pass TreeSearch::group_pass(std::string_view kernel, Parameters parameters, std::uint32_t groups, std::uint32_t threads) const {
  return make_pass(bodies_.arrays, kernel, bodies_.arrays.device().group_kernel(kernel, threads), parameters, groups);
}

std::vector<Pass> TreeSearch::fitting_passes(std::string_view bounding, std::string_view fitting,
                                             const Parameters& parameters) const {
  std::vector<Pass> passes;
  if (is_hybrid_) {
    passes.push_back(group_pass(bounding, parameters, treelet_count_));
    passes.push_back(make_pass(bodies_.arrays, "pair_treelets", {{"search_threads", pairing_threads_}}, pairing_threads_));
  }
  passes.push_back(group_pass(fitting, parameters, treelet_count_, threads_of_a_refit_));
  return passes;
}

std::vector<Pass> TreeSearch::refitting_passes(std::uint32_t half) const {
  return fitting_passes("bound_treelets", "refit", {{"first_position", bodies_.first_of_half(half)}});
}

Pass TreeSearch::finding_pass() const { return group_pass("find_pairs", {{"search_groups", search_groups_}}, search_groups_); }

std::vector<Pass> TreeSearch::cage_passes(std::uint32_t triangle_pair_capacity) const {
  const Device& device = bodies_.arrays.device();
  // of a pair of leaves: a GPU waits for its slowest
  const std::uint32_t threads = device.info().kind == DeviceKind::gpu ? 4 : 1;
  const std::uint32_t leaf_pairs = device.items_of_lists(bodies_.body_count) / threads;
  Pass listing = make_pass(
      bodies_.arrays, "list_triangle_pairs",
      {{"triangle_pair_capacity", triangle_pair_capacity}, {"pairs_at_once", leaf_pairs}, {"threads_of_a_pair", threads}},
      threads * leaf_pairs);
  std::vector<Pass> passes = fitting_passes("bound_cage_treelets", "refit_cages", {});
  passes.push_back(finding_pass());
  std::ranges::move(
      serving_passes(std::move(listing), "list_unlisted_pairs", {{"triangle_pair_capacity", triangle_pair_capacity}}),
      std::back_inserter(passes));
  return passes;
}

std::vector<Pass> TreeSearch::serving_passes(Pass of_list, std::string_view kernel_of_all, Parameters parameters) const {
  if (!may_lack_room_) return {std::move(of_list)};
  const std::uint32_t groups = std::min(search_groups_, most_unlisted_groups);
  parameters.emplace_back("search_groups", groups);
  return {beside_next(std::move(of_list)), group_pass(kernel_of_all, std::move(parameters), groups)};
}

std::vector<glm::uvec2> TreeSearch::leaf_pairs() const {
  const std::uint32_t found = bodies_.control.download().front().leaf_pair_count;
  std::vector<glm::uvec2> pairs = bodies_.arrays.get<glm::uvec2>("leaf_pair").download(0, std::min(found, leaf_pair_capacity_));
  for (glm::uvec2& pair : pairs) pair = {in_forest_[pair.x], in_forest_[pair.y]};
  return pairs;
}

std::vector<glm::vec4> TreeSearch::node_boxes() const {
  const std::vector<glm::vec4> on_device = bodies_.arrays.get<glm::vec4>("node_box").download();
  std::vector<glm::vec4> boxes(2 * (in_forest_.empty() ? 0 : std::ranges::max(in_forest_) + 1));
  for (std::size_t n = 0; n < in_forest_.size(); ++n)
    for (std::size_t k = 0; k < 2; ++k) boxes[2 * in_forest_[n] + k] = on_device[2 * n + k];
  return boxes;
}

}  // namespace pliant
