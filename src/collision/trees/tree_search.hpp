// The forest on a device: refits the trees of near bodies and descends them to pairs of leaves.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "collision/trees/tree.hpp"
#include "collision/trees/treelets.hpp"
#include "device/device.hpp"
#include "device/pass.hpp"
#include "physics/control.glsl"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Returns how many pairs of a list are served at once, if only the device knows the list's length. They are as many as keep the
/// device busy, but not too few.
[[nodiscard]] std::uint32_t pairs_at_once(std::uint32_t parallel_items, std::uint32_t threads_per_pair, std::uint32_t most_pairs);

class TreeSearch {
 public:
  /// `bodies` must outlive this. Searches are cut for `parallel_items` threads at once. A full list costs speed, never a contact:
  /// - Of leaves: the trees are then descended twice, and pairs served where they are found.
  /// - Of treelets: all treelets of near bodies are then refitted, and all their pairs descended.
  TreeSearch(DeviceBodies& bodies, const Forest& forest, const CollisionDescription& description, std::uint32_t parallel_items,
             std::uint32_t most_near_pairs);

  /// Refit the trees of bodies that are near another to the positions at `half`.
  [[nodiscard]] std::vector<Pass> refitting_passes(std::uint32_t half) const;
  /// Lists the pairs of leaves whose boxes overlap.
  [[nodiscard]] Pass finding_pass() const;
  /// Returns `of_list`, which serves the listed pairs of leaves. If the list may be too short a second pass follows. It serves
  /// all pairs in a step in which the list was, and `of_list` none then. `kernel_of_all` takes these parameters besides those of
  /// a search.
  [[nodiscard]] std::vector<Pass> serving_passes(Pass of_list, std::string_view kernel_of_all, Parameters parameters) const;
  /// Do the same for the cages of vertices (responses/impulse.hpp), and list pairs of triangles whose cages overlap.
  [[nodiscard]] std::vector<Pass> cage_passes(std::uint32_t triangle_pair_capacity) const;

  /// A treelet has so many triangles at most, unless it is a leaf. Boxes above treelets are not kept.
  [[nodiscard]] std::uint32_t triangles_of_a_treelet() const { return triangles_of_a_treelet_; }
  /// The next two read memory that arrays share (state/shared_memory.hpp). They hold only from a search's passes until other
  /// passes run. They number nodes as the forest does.
  /// Returns the search's pairs of leaves whose boxes overlap, in no fixed order. There are as many as fit the list.
  [[nodiscard]] std::vector<glm::uvec2> leaf_pairs() const;
  /// Returns [node][2]: lower and upper corners [m]. Boxes of bodies without a partner are not refitted. Those that no search
  /// needs are not, either, unless refits are bottom-up.
  [[nodiscard]] std::vector<glm::vec4> node_boxes() const;

 private:
  [[nodiscard]] std::vector<Pass> fitting_passes(std::string_view bounding, std::string_view fitting,
                                                 const Parameters& parameters) const;
  [[nodiscard]] Pass group_pass(std::string_view kernel, Parameters parameters, std::uint32_t groups,
                                std::uint32_t threads = physics::group_size) const;

  DeviceBodies& bodies_;
  std::uint32_t leaf_pair_capacity_, treelet_count_ = 0;
  bool may_lack_room_;  // all pairs of leaves are more than it has room for
  std::uint32_t triangles_of_a_treelet_;
  bool is_hybrid_ = false;  // a refit leaves out treelets that meet no other
  std::uint32_t search_groups_ = 0, pairing_threads_ = 0, threads_of_a_refit_ = physics::group_size;
  std::vector<std::uint32_t> in_forest_;  // the number there of each node on the device
};

}  // namespace pliant
