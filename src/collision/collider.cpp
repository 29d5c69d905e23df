#include "collision/collider.hpp"

#include <algorithm>

namespace pliant {
namespace {

// The name has to be right even where there is nothing to touch. Responses move scripted bodies, too.
ResponseRow row_of(const CollisionDescription& description, bool is_needed) {
  const ResponseRow& named = find_response(description.response);
  return is_needed ? named : ResponseRow();
}

bool has_paths(const Model& model) {
  return std::ranges::any_of(model.bodies, [](const ModelBody& body) { return body.path.has_value(); });
}

// Where nothing can touch, each tree is a root alone: splitting many triangles takes long.
TreeDescription tree_for(const TreeDescription& tree, bool is_searched) {
  TreeDescription needed = tree;
  if (!is_searched) needed.max_depth = 0;
  return needed;
}

std::uint32_t items_of(const DeviceBodies& bodies, std::optional<std::uint32_t> parallel_items) {
  return parallel_items.value_or(bodies.arrays.device().parallel_items(bodies.body_count));
}

}  // namespace

Collider::Collider(DeviceBodies& bodies, const Model& model, const CollisionDescription& description, StepTraits steps,
                   std::optional<std::uint32_t> parallel_items, bool sleeps)
    : description_(description),
      searches_(model.has_surfaces_to_touch()),
      has_rigid_(std::ranges::any_of(model.bodies, &ModelBody::is_rigid)),
      forest_(build_forest(model, model.rest_positions, tree_for(description.tree, searches_))),
      body_pairs_(bodies, model, description.broad_phase),
      trees_(bodies, forest_, description, items_of(bodies, parallel_items), body_pairs_.most_pairs()),
      touching_(bodies, model, description.triangle_test, items_of(bodies, parallel_items), body_pairs_.most_pairs()),
      response_row_(row_of(description, searches_ || !model.grounds.empty() || has_paths(model))) {
  if (response_row_.make != nullptr)
    response_ = response_row_.make({bodies, model, description, forest_, body_pairs_, trees_, steps, sleeps});
}

bool Collider::uses_trees() const { return description_.search == ContactSearch::tree && searches_; }

std::vector<Pass> Collider::pairing_passes(std::uint32_t half) const {
  if (!searches_) return {};
  std::vector<Pass> passes = body_pairs_.pairing_passes();
  if (has_rigid_) passes.insert(passes.begin(), bounding_pass(half));
  return passes;
}

std::vector<Pass> Collider::refitting_passes(std::uint32_t half) const {
  if (!uses_trees()) return {};
  return trees_.refitting_passes(half);
}

std::vector<Pass> Collider::finding_passes() const {
  if (!uses_trees()) return {};
  return {trees_.finding_pass()};
}

std::vector<Pass> Collider::testing_passes(std::uint32_t half) const {
  if (!searches_) return {};
  if (!uses_trees()) return {touching_.brute_force_pass(half)};
  return trees_.serving_passes(touching_.testing_pass(half), "test_unlisted_pairs", touching_.test_parameters(half));
}

std::vector<Pass> Collider::search_passes(std::uint32_t half) const {
  std::vector<Pass> all = pairing_passes(half);
  for (const auto& passes : {refitting_passes(half), finding_passes(), testing_passes(half)})
    all.insert(all.end(), passes.begin(), passes.end());
  return all;
}

}  // namespace pliant
