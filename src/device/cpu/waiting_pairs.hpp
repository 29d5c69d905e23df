// Pairs of triangles that a kernel has to test. They wait until there are enough for a vector.
#pragma once
#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "device/cpu/isa.hpp"
#include "device/cpu/triangle_lanes.hpp"

namespace pliant::cpu {

/// Returns the test for an instruction set. Expects one that is available.
[[nodiscard]] LaneTest lane_test(Isa isa);

/// Sets the corners of the triangles of one pair. `corner_of` takes 0 or 1 for the triangle, and the corner's number.
template <class CornerOf>
void set_lane(TriangleLanes& pairs, unsigned lane, const CornerOf& corner_of) {
  for (unsigned triangle = 0; triangle < 2; ++triangle)
    for (unsigned k = 0; k < 3; ++k) {
      const glm::vec4 corner = corner_of(triangle, k);
      pairs.corner[triangle][k][0][lane] = corner.x;
      pairs.corner[triangle][k][1][lane] = corner.y;
      pairs.corner[triangle][k][2][lane] = corner.z;
    }
}

/// A pair is the numbers of its triangles. For them the kernel has corner_at(), triangles_touch() and mark_vertices()
/// (kernels/parts/test_triangles.glsl).
class WaitingPairs {
 public:
  /// Expects that not all places are taken.
  void add(glm::uvec2 pair) { pair_[count_++] = pair; }
  [[nodiscard]] unsigned count() const { return count_; }
  [[nodiscard]] bool is_full() const { return count_ == most_lanes; }

  /// Tests all that wait, and marks the vertices of those that touch. Returns how many those are.
  template <class Kernel>
  unsigned test_by_kernel(Kernel& kernel) {
    return mark_touching(kernel, {0, all()});
  }
  /// The same in vectors. Expects that triangles_touch() is triangles_may_touch().
  template <class Kernel>
  unsigned test_in_vectors(Kernel& kernel) {
    for (unsigned lane = 0; lane < count_; ++lane)
      set_lane(lanes_, lane,
               [&](unsigned triangle, unsigned k) { return kernel.corner_at(triangle == 0 ? pair_[lane].x : pair_[lane].y, k); });
    return mark_touching(kernel, test_(lanes_, count_));
  }

 private:
  [[nodiscard]] std::uint32_t all() const { return (1u << count_) - 1; }

  template <class Kernel>
  unsigned mark_touching(Kernel& kernel, LaneAnswers answers) {
    unsigned touching = 0;
    for (std::uint32_t left = (answers.touching | answers.unknown) & all(); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      const glm::uvec2 pair = pair_[k];
      if ((answers.unknown >> k & 1u) != 0 && !kernel.triangles_touch(pair.x, pair.y)) continue;
      kernel.mark_vertices(pair.x, pair.y);
      ++touching;
    }
    count_ = 0;
    return touching;
  }

  LaneTest test_ = lane_test(available_isas().back());
  unsigned count_ = 0;
  glm::uvec2 pair_[most_lanes];
  TriangleLanes lanes_;
};

}  // namespace pliant::cpu
