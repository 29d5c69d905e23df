// Sums all springs of all bodies at once, in the widest vectors that the processor has and on all threads.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "device/cpu/isa.hpp"
#include "device/cpu/spring_tile.hpp"

namespace pliant::cpu {

/// One body whose springs are summed, for all of its vertices or for some.
template <class Real>
struct SpringBody {
  const glm::vec<4, Real>* positions;      // in a unit near the body's radius
  const glm::vec<4, Real>* displacements;  // in the same unit
  std::uint32_t vertex_count;
  std::uint32_t first_wanted, wanted_count;  // the vertices whose sums are wanted
  glm::dvec3* sums;  // out: of each, the sum of strain times length over its springs (physics/forces/spring.glsl) [units]
};

/// Sums springs in scratch memory of its own, up to some 32 numbers per vertex and direction. If a vertex is not finite, sums of
/// its body are not finite.
template <class Real>
class SpringSums {
 public:
  /// The most vertices of a body that sum_alone() takes.
  static constexpr std::uint32_t most_vertices_alone = 256;

  /// Expects an instruction set that is available.
  explicit SpringSums(Isa isa);

  /// Gives the same bits for any number of threads. Sums of a body add up to zero but for rounding.
  void sum(ThreadPool& pool, std::span<const SpringBody<Real>> bodies);
  /// Sums one body's springs on the calling thread, to the same bits and without scratch memory.
  void sum_alone(const SpringBody<Real>& body) const;
  /// Returns the scratch memory that a body of so many vertices takes [bytes].
  [[nodiscard]] static std::size_t scratch_bytes_of(std::uint32_t vertex_count);
  /// Returns the scratch memory of the latest sum [bytes].
  [[nodiscard]] std::size_t scratch_bytes() const;

 private:
  // A body's place in scratch memory. Arrays have `stride` numbers. Vectors are three arrays.
  struct Layout {
    std::uint32_t vertex_count, stride, padding, block_length, block_count;  // padding comes first
    std::size_t first_place;                                                 // of positions, then half displacements
    std::size_t first_sum;                           // of block_count vectors: the sums from the vertices of each block
    std::uint32_t first_wanted = 0, end_wanted = 0;  // vertices

    // The first block can be short.
    [[nodiscard]] std::uint32_t begin_of(std::uint32_t block) const {
      return block == 0 ? 0 : stride - (block_count - block) * block_length;
    }
    /// Whether sums of vertices of the block are wanted.
    [[nodiscard]] bool wants(std::uint32_t block) const {
      return begin_of(block) < padding + end_wanted && padding + first_wanted < begin_of(block + 1);
    }
    [[nodiscard]] std::uint64_t length_of(std::uint32_t block) const { return begin_of(block + 1) - begin_of(block); }
  };
  struct Task {
    std::uint32_t body, row_block, column_block;
    std::uint64_t pair_count;
  };
  struct Chunk {
    std::uint32_t body, first, end;  // vertices
  };
  struct alignas(64) Line {
    Real numbers[64 / sizeof(Real)];
  };

  [[nodiscard]] static Layout layout_of(std::uint32_t vertex_count);  // at the beginning of scratch
  void plan(std::span<const SpringBody<Real>> bodies);
  void add_tasks(std::uint32_t body);
  // These take where the body's places and sums stand.
  static void pack(const SpringBody<Real>& body, const Layout& layout, std::uint32_t first, std::uint32_t end, Real* places);
  void run(const Layout& layout, std::uint32_t row_block, std::uint32_t column_block, Real* places, double* sums) const;
  static void unpack(const SpringBody<Real>& body, const Layout& layout, std::uint32_t first, std::uint32_t end,
                     const double* sums);
  [[nodiscard]] Real* places(const Layout& layout) { return places_.data()->numbers + layout.first_place; }
  [[nodiscard]] double* sums(const Layout& layout) { return sums_.data() + layout.first_sum; }

  TileFunction<Real> sum_tile_;
  std::vector<Layout> layouts_;
  std::vector<Task> tasks_;    // the largest first
  std::vector<Chunk> chunks_;  // all vertices
  std::vector<Line> places_;
  std::vector<double> sums_;
};

extern template class SpringSums<float>;
extern template class SpringSums<double>;

}  // namespace pliant::cpu
