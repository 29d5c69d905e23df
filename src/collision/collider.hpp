// Records the dispatches that find and answer contacts between bodies at the end of a step.
#pragma once
#include <optional>
#include <vector>

#include "collision/tree.hpp"
#include "device/pass.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class Collider {
 public:
  /// `bodies` must outlive the collider. The trees' structure comes from the rest positions.
  /// Searches are cut for so many threads at once; else for as many as keep the device busy.
  Collider(DeviceBodies& bodies, const Model& model, const CollisionDescription& description,
           std::optional<std::uint32_t> parallel_items = {});
  Collider(const Collider&) = delete;
  Collider& operator=(const Collider&) = delete;

  /// Bounds every body at `half`. A step does that itself as it ends.
  [[nodiscard]] std::vector<Pass> bounding_passes(std::uint32_t half) const;
  /// Finds the triangles of different bodies that touch at `half` and marks their vertices, between bodies whose boxes overlap. A
  /// pass that changes neither world positions nor what is the collider's own may run beside any of them but the first.
  [[nodiscard]] std::vector<Pass> contact_passes(std::uint32_t half) const;
  /// Moves marked vertices of the other half back to `from_half`.
  [[nodiscard]] std::vector<Pass> response_passes(std::uint32_t from_half) const;

  /// Whether contact_passes refits and searches trees: two bodies or more with triangles, and no brute force.
  [[nodiscard]] bool uses_trees() const;
  [[nodiscard]] const Forest& forest() const { return forest_; }
  /// Searches start from the nodes at this depth; boxes of those above are not kept.
  [[nodiscard]] unsigned start_depth() const { return start_depth_; }
  /// Of the latest search: two leaves whose boxes overlap, in no fixed order, as many as fit the list.
  [[nodiscard]] std::vector<glm::uvec2> leaf_pairs() const;
  /// [node][2]: lower and upper corners, as of the latest refit of the node's body.
  [[nodiscard]] std::vector<glm::vec4> node_boxes() const;
  /// Of every vertex, the latest step in which it touched another body; 0: none.
  [[nodiscard]] std::vector<std::uint32_t> marks() const;
  void restore_marks(std::span<const std::uint32_t> marks);

 private:
  [[nodiscard]] std::vector<Pass> tree_passes(std::uint32_t first_position) const;
  [[nodiscard]] std::vector<Pass> brute_force_passes(std::uint32_t first_position) const;
  [[nodiscard]] std::uint32_t pairs_at_once(std::uint32_t threads_per_pair) const;

  DeviceBodies& bodies_;
  CollisionDescription description_;
  Forest forest_;
  std::uint32_t parallel_items_;  // threads that a search is cut for
  unsigned start_depth_;          // of the nodes that searches start from
  std::uint32_t largest_body_;    // triangles
  std::uint32_t most_near_pairs_;
};

}  // namespace pliant
