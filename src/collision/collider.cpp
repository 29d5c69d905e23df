// bound bodies -> pair them -> refit the trees of those that are near -> find candidate pairs -> test them -> respond.
#include "collision/collider.hpp"

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"

namespace pliant {
namespace {

using physics::Control;

static_assert(static_cast<std::uint32_t>(TriangleTest::certified) == physics::certified_test);
static_assert(static_cast<std::uint32_t>(TriangleTest::moller) == physics::moller_test);

// A full list costs speed, never a contact: the thread that finds a pair then tests it itself.
constexpr std::size_t candidate_capacity = std::size_t{1} << 18;

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

}  // namespace

Collider::Collider(Device& device, DeviceBodies& bodies, const Model& model, const CollisionDescription& description)
    : device_(device),
      bodies_(bodies),
      description_(description),
      forest_(build_forest(model, model.rest_positions, description.tree)),
      largest_body_(largest_triangle_count(model)),
      trees_(device, trees_of(forest_), "trees"),
      leaves_(device, forest_.leaves, "tree leaves"),
      nodes_(device, forest_.nodes, "tree nodes"),
      node_boxes_(device, 2 * forest_.nodes.size(), "tree boxes"),
      triangles_(device, corners_of(forest_), "triangles"),
      arrivals_(device, forest_.nodes.size(), "tree arrivals"),
      partner_steps_(device, bodies.body_count, "partner steps"),
      near_pairs_(device, std::size_t{bodies.body_count} * (bodies.body_count - 1) / 2, "near pairs"),
      candidates_(device, candidate_capacity, "candidate pairs"),
      marks_(device, bodies.vertex_count, "contact marks") {
  if (physics::pairs_at_once(threads_per_pair()) == 0)
    throw Error(ErrorKind::input, "collision.search", "brute force takes bodies of up to 4,194,240 triangles",
                "use search = \"tree\"");
}

std::uint32_t Collider::threads_per_pair() const {
  if (description_.search == ContactSearch::tree) return physics::descent_threads;
  return physics::groups_for(largest_body_) * physics::group_size;
}

bool Collider::uses_trees() const {
  return description_.search == ContactSearch::tree && bodies_.body_count > 1 && !forest_.leaves.empty();
}

std::vector<Pass> Collider::bounding_passes(std::uint32_t half) const {
  const DeviceBodies& b = bodies_;
  return {make_pass(device_, "bound_bodies",
                    {b.control.id(), b.rest_positions.id(), b.motions.id(), b.world_positions.id(), b.body_boxes.id()},
                    {b.vertex_count, half}, b.vertex_count)};
}

std::vector<Pass> Collider::contact_passes(std::uint32_t half) const {
  const DeviceBodies& b = bodies_;
  const auto leaf_count = static_cast<std::uint32_t>(forest_.leaves.size());
  if (b.body_count < 2 || leaf_count == 0) return {};
  std::vector<Pass> result = {make_pass(device_, "pair_bodies",
                                        {b.control.id(), trees_.id(), b.body_boxes.id(), near_pairs_.id(), partner_steps_.id()},
                                        {b.body_count, leaf_count, threads_per_pair()}, b.body_count * b.body_count)};
  const std::uint32_t first_position = half * b.vertex_count;
  const auto search =
      description_.search == ContactSearch::tree ? tree_passes(first_position) : brute_force_passes(first_position);
  result.insert(result.end(), search.begin(), search.end());
  return result;
}

std::vector<Pass> Collider::tree_passes(std::uint32_t first_position) const {
  const DeviceBodies& b = bodies_;
  const auto leaf_count = static_cast<std::uint32_t>(forest_.leaves.size());
  const auto test = static_cast<std::uint32_t>(description_.triangle_test);
  const auto capacity = static_cast<std::uint32_t>(candidates_.size());
  return {make_indirect_pass(device_, "refit",
                             {b.control.id(), leaves_.id(), nodes_.id(), node_boxes_.id(), triangles_.id(),
                              b.world_positions.id(), arrivals_.id(), partner_steps_.id()},
                             {leaf_count, first_position}, b.control.id(), offsetof(Control, refit_groups)),
          make_indirect_pass(device_, "find_pairs",
                             {b.control.id(), near_pairs_.id(), nodes_.id(), node_boxes_.id(), triangles_.id(),
                              b.world_positions.id(), candidates_.id(), marks_.id()},
                             {b.vertex_count, first_position, test, capacity}, b.control.id(), offsetof(Control, find_groups)),
          make_indirect_pass(device_, "test_pairs",
                             {b.control.id(), candidates_.id(), triangles_.id(), b.world_positions.id(), marks_.id()},
                             {b.vertex_count, first_position, test, capacity}, b.control.id(), offsetof(Control, test_groups))};
}

std::vector<Pass> Collider::brute_force_passes(std::uint32_t first_position) const {
  const DeviceBodies& b = bodies_;
  return {make_indirect_pass(
      device_, "test_all_pairs",
      {b.control.id(), near_pairs_.id(), nodes_.id(), triangles_.id(), b.world_positions.id(), marks_.id()},
      {b.vertex_count, first_position, static_cast<std::uint32_t>(description_.triangle_test), threads_per_pair()},
      b.control.id(), offsetof(Control, find_groups))};
}

std::vector<Pass> Collider::response_passes(std::uint32_t from_half) const {
  const DeviceBodies& b = bodies_;
  return {make_indirect_pass(
      device_, "respond",
      {b.control.id(), b.rest_positions.id(), marks_.id(), b.frames.id(), b.motions.id(), b.world_positions.id()},
      {b.vertex_count, from_half, description_.elasticity}, b.control.id(), offsetof(Control, respond_groups))};
}

std::vector<glm::uvec2> Collider::candidates() const {
  const std::uint32_t found = bodies_.control.download().front().candidate_count;
  return candidates_.download(0, std::min<std::size_t>(found, candidates_.size()));
}

}  // namespace pliant
