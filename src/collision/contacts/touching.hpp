// Finds which triangles of different bodies touch, and marks their vertices with the step's number. A mark is the same whichever
// contact comes first, so the order of contacts changes nothing.
#pragma once
#include <span>
#include <vector>

#include "device/pass.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class Touching {
 public:
  /// `bodies` must outlive this.
  Touching(DeviceBodies& bodies, const Model& model, TriangleTest test, std::uint32_t parallel_items,
           std::uint32_t most_near_pairs);

  /// What kernels that test triangles have to know, as they stand at `half`.
  [[nodiscard]] Parameters test_parameters(std::uint32_t half) const;
  /// Tests the triangles of listed pairs of leaves (TreeSearch), unless the list was too short.
  [[nodiscard]] Pass testing_pass(std::uint32_t half) const;
  /// Tests every two triangles of near bodies instead.
  [[nodiscard]] Pass brute_force_pass(std::uint32_t half) const;

  /// Returns for every vertex the latest step in which it touched another body, or 0 if there is none.
  [[nodiscard]] std::vector<std::uint32_t> marks() const;
  void restore_marks(std::span<const std::uint32_t> marks);

 private:
  DeviceBodies& bodies_;
  std::uint32_t triangle_test_;
  std::uint32_t parallel_items_;   // threads that a search is cut for
  std::uint32_t most_near_pairs_;  // of bodies
  std::uint32_t largest_body_;     // triangles
};

}  // namespace pliant
