// Finds contacts between bodies and answers them: pairs of bodies, trees, touching triangles, and the scene's response.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "collision/broad_phase/body_pairs.hpp"
#include "collision/contacts/touching.hpp"
#include "collision/responses/response.hpp"
#include "collision/trees/tree_search.hpp"

namespace pliant {

class Collider {
 public:
  /// `bodies` and `model` must outlive the collider. The trees' structure comes from the rest positions. Searches are cut for
  /// `parallel_items` threads at once, or else for as many as keep the device busy. Throws Error if there is no such response.
  Collider(DeviceBodies& bodies, const Model& model, const CollisionDescription& description, StepTraits steps = {},
           std::optional<std::uint32_t> parallel_items = {}, bool sleeps = false);
  Collider(const Collider&) = delete;
  Collider& operator=(const Collider&) = delete;

  /// Returns null if contacts are not answered.
  [[nodiscard]] const Response* response() const { return response_.get(); }
  [[nodiscard]] Response* response() { return response_.get(); }
  /// Returns what is known of the response. It is "none" if contacts are not answered.
  [[nodiscard]] const ResponseRow& response_row() const { return response_row_; }
  /// Returns whether there are two surfaces to touch.
  [[nodiscard]] bool searches() const { return searches_; }
  /// Returns whether a search refits and descends trees, instead of testing every two triangles.
  [[nodiscard]] bool uses_trees() const;

  /// Bounds every body at `half`. A step does that itself as it ends, but for rigid bodies.
  [[nodiscard]] Pass bounding_pass(std::uint32_t half) const { return body_pairs_.bounding_pass(half); }
  /// Returns how many pairs of bodies a search looks at, or leaves out because their boxes are apart.
  [[nodiscard]] std::uint32_t pair_count() const { return searches_ ? body_pairs_.pair_count() : 0; }
  /// Return the passes of a search at `half`, which run in this order:
  /// - Pairing finds pairs of bodies. If there are rigid ones, it bounds bodies first.
  /// - Refitting and finding have passes only if the search uses trees: for the trees' boxes, and for pairs of leaves.
  /// - Testing finds touching triangles and marks their vertices.
  /// A pass may run beside those after pairing if it changes neither world positions nor the collider's own arrays.
  [[nodiscard]] std::vector<Pass> pairing_passes(std::uint32_t half) const;
  [[nodiscard]] std::vector<Pass> refitting_passes(std::uint32_t half) const;
  [[nodiscard]] std::vector<Pass> finding_passes() const;
  [[nodiscard]] std::vector<Pass> testing_passes(std::uint32_t half) const;
  /// Returns all passes of a search.
  [[nodiscard]] std::vector<Pass> search_passes(std::uint32_t half) const;

  [[nodiscard]] const Forest& forest() const { return forest_; }
  [[nodiscard]] const TreeSearch& trees() const { return trees_; }
  [[nodiscard]] const Touching& touching() const { return touching_; }
  [[nodiscard]] Touching& touching() { return touching_; }

 private:
  CollisionDescription description_;
  bool searches_, has_rigid_;
  Forest forest_;
  BodyPairs body_pairs_;
  TreeSearch trees_;
  Touching touching_;
  ResponseRow response_row_;
  std::unique_ptr<Response> response_;  // null if contacts are not answered
};

}  // namespace pliant
