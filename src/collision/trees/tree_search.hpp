// The forest on a device: refits the trees of near bodies and descends them to pairs of leaves.
#pragma once
#include <vector>

#include "collision/trees/tree.hpp"
#include "device/pass.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Returns how many pairs of a list are served at once, if only the device knows the list's length. They are as many as keep the
/// device busy, but not too few.
[[nodiscard]] std::uint32_t pairs_at_once(std::uint32_t parallel_items, std::uint32_t threads_per_pair, std::uint32_t most_pairs);

class TreeSearch {
 public:
  /// `bodies` must outlive this. Searches are cut for `parallel_items` threads at once. Their list has room for so many pairs of
  /// leaves. A full list costs speed, never a contact: the trees are then descended twice, and pairs served where they are found.
  TreeSearch(DeviceBodies& bodies, const Forest& forest, std::uint32_t leaf_pair_capacity, std::uint32_t parallel_items,
             std::uint32_t most_near_pairs);

  /// Refits the trees of bodies that are near another to the positions at `half`.
  [[nodiscard]] Pass refitting_pass(std::uint32_t half) const;
  /// Lists the pairs of leaves whose boxes overlap.
  [[nodiscard]] Pass finding_pass() const;
  /// Returns `of_list`, which serves the listed pairs of leaves. If the list may be too short a second pass follows. It serves
  /// all pairs in a step in which the list was, and `of_list` none then. `kernel_of_all` takes these parameters besides those of
  /// a search.
  [[nodiscard]] std::vector<Pass> serving_passes(Pass of_list, std::string_view kernel_of_all, Parameters parameters) const;
  /// Do the same for the cages of vertices (responses/impulse.hpp), and list pairs of triangles whose cages overlap.
  [[nodiscard]] std::vector<Pass> cage_passes(std::uint32_t triangle_pair_capacity) const;

  /// Searches start from leaves, and from the highest nodes with so many triangles or fewer. Boxes of those above are not kept.
  [[nodiscard]] std::uint32_t triangles_of_a_start() const { return triangles_of_a_start_; }
  /// The next two read memory that arrays share (state/shared_memory.hpp). They hold only from a search's passes until other
  /// passes run.
  /// Returns the search's pairs of leaves whose boxes overlap, in no fixed order. There are as many as fit the list.
  [[nodiscard]] std::vector<glm::uvec2> leaf_pairs() const;
  /// Returns [node][2]: lower and upper corners [m]. Boxes of bodies without a partner are not refitted.
  [[nodiscard]] std::vector<glm::vec4> node_boxes() const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t leaf_count_, leaf_pair_capacity_;
  bool may_lack_room_;  // all pairs of leaves are more than it has room for
  std::uint32_t triangles_of_a_start_;
  std::uint32_t search_threads_ = 0;
};

}  // namespace pliant
