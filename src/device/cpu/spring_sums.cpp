// Cuts a body's vertices into blocks. Every pair of blocks is a task that leaves its two sums in places of their own. So the
// order of additions depends on no thread.
#include "device/cpu/spring_sums.hpp"

#include <algorithm>
#include <array>

#include "core/expect.hpp"

namespace pliant::cpu {
namespace {

constexpr std::uint32_t shortest_block = 256;  // block lengths are multiples, so that a row takes whole rounds of its loop
constexpr std::uint32_t most_blocks = 32;
constexpr std::uint32_t chunk_length = 256;
static_assert(SpringSums<float>::most_vertices_alone <= shortest_block &&
              SpringSums<double>::most_vertices_alone <= shortest_block);

constexpr std::uint32_t ratio_up(std::uint32_t count, std::uint32_t length) { return (count + length - 1) / length; }

template <class Real>
TileFunction<Real> tile_function(Isa isa) {
#ifdef PLIANT_X86_TILES
  if (isa == Isa::avx512) return &sum_tile_avx512;
  if (isa == Isa::avx2) return &sum_tile_avx2;
#endif
  PLIANT_EXPECT(isa == Isa::portable);
  return &sum_tile_portable;
}

}  // namespace

template <class Real>
SpringSums<Real>::SpringSums(Isa isa) : sum_tile_(tile_function<Real>(isa)) {
  PLIANT_EXPECT(std::ranges::find(available_isas(), isa) != available_isas().end());
}

template <class Real>
void SpringSums<Real>::sum(ThreadPool& pool, std::span<const SpringBody<Real>> bodies) {
  if (bodies.empty()) return;
  const auto same_size = [](const SpringBody<Real>& body, const Layout& layout) {
    return body.vertex_count == layout.vertex_count && body.first_wanted == layout.first_wanted &&
           body.first_wanted + body.wanted_count == layout.end_wanted;
  };
  if (!std::ranges::equal(bodies, layouts_, same_size)) plan(bodies);
  const auto chunk_count = static_cast<std::uint32_t>(chunks_.size());
  pool.for_ranges(chunk_count, 8, [&](std::uint32_t first, std::uint32_t end) {
    for (const Chunk& chunk : std::span(chunks_).subspan(first, end - first)) {
      const Layout& layout = layouts_[chunk.body];
      pack(bodies[chunk.body], layout, chunk.first, chunk.end, places(layout));
    }
  });
  pool.for_ranges(static_cast<std::uint32_t>(tasks_.size()), 1, [&](std::uint32_t t, std::uint32_t) {
    const Task& task = tasks_[t];
    const Layout& layout = layouts_[task.body];
    run(layout, task.row_block, task.column_block, places(layout), sums(layout));
  });
  pool.for_ranges(chunk_count, 2, [&](std::uint32_t first, std::uint32_t end) {
    for (const Chunk& chunk : std::span(chunks_).subspan(first, end - first)) {
      const Layout& layout = layouts_[chunk.body];
      unpack(bodies[chunk.body], layout, std::max(chunk.first, layout.first_wanted), std::min(chunk.end, layout.end_wanted),
             sums(layout));
    }
  });
}

template <class Real>
void SpringSums<Real>::sum_alone(const SpringBody<Real>& body) const {
  PLIANT_EXPECT(body.vertex_count <= most_vertices_alone);
  const Layout layout = layout_of(body.vertex_count);
  alignas(64) std::array<Real, 6 * most_vertices_alone> places;
  std::array<double, 3 * most_vertices_alone> sums;
  pack(body, layout, 0, body.vertex_count, places.data());
  run(layout, 0, 0, places.data(), sums.data());
  unpack(body, layout, 0, body.vertex_count, sums.data());
}

template <class Real>
std::size_t SpringSums<Real>::scratch_bytes() const {
  return places_.size() * sizeof(Line) + sums_.size() * sizeof(double);
}

template <class Real>
std::size_t SpringSums<Real>::scratch_bytes_of(std::uint32_t vertex_count) {
  const Layout layout = layout_of(vertex_count);
  return std::size_t{layout.stride} * (6 * sizeof(Real) + 3 * layout.block_count * sizeof(double));
}

template <class Real>
typename SpringSums<Real>::Layout SpringSums<Real>::layout_of(std::uint32_t vertex_count) {
  const std::uint32_t stride = ratio_up(vertex_count, widest_vector<Real>) * widest_vector<Real>;
  const std::uint32_t length = shortest_block * std::max(ratio_up(stride, shortest_block * most_blocks), 1u);
  return {vertex_count, stride, stride - vertex_count, length, ratio_up(stride, length), 0, 0};
}

template <class Real>
void SpringSums<Real>::plan(std::span<const SpringBody<Real>> bodies) {
  layouts_.clear();
  tasks_.clear();
  chunks_.clear();
  std::size_t place_count = 0, sum_count = 0;
  for (const SpringBody<Real>& body : bodies) {
    const std::uint32_t count = body.vertex_count;
    const auto b = static_cast<std::uint32_t>(layouts_.size());
    layouts_.push_back(layout_of(count));
    layouts_.back().first_place = place_count;
    layouts_.back().first_sum = sum_count;
    layouts_.back().first_wanted = body.first_wanted;
    layouts_.back().end_wanted = body.first_wanted + body.wanted_count;
    place_count += std::size_t{6} * layouts_.back().stride;
    sum_count += std::size_t{3} * layouts_.back().block_count * layouts_.back().stride;
    add_tasks(b);
    for (std::uint32_t first = 0; first < count; first += chunk_length)
      chunks_.push_back({b, first, std::min(first + chunk_length, count)});
  }
  places_.resize((place_count * sizeof(Real) + sizeof(Line) - 1) / sizeof(Line));
  sums_.resize(sum_count);
  std::ranges::stable_sort(tasks_, std::greater(), &Task::pair_count);
}

template <class Real>
void SpringSums<Real>::add_tasks(std::uint32_t body) {
  const Layout& layout = layouts_[body];
  for (std::uint32_t row = 0; row < layout.block_count; ++row)
    for (std::uint32_t column = row; column < layout.block_count; ++column)
      if (layout.wants(row) || layout.wants(column))
        tasks_.push_back({body, row, column, layout.length_of(row) * layout.length_of(column) / (row == column ? 2 : 1)});
}

template <class Real>
void SpringSums<Real>::pack(const SpringBody<Real>& body, const Layout& layout, std::uint32_t first, std::uint32_t end,
                            Real* places) {
  Real* const position = places + layout.padding;
  Real* const half_displacement = position + 3 * std::size_t{layout.stride};
  for (std::uint32_t i = first; i < end; ++i)
    for (std::uint32_t k = 0; k < 3; ++k) {
      position[k * std::size_t{layout.stride} + i] = body.positions[i][static_cast<int>(k)];
      half_displacement[k * std::size_t{layout.stride} + i] = Real(0.5) * body.displacements[i][static_cast<int>(k)];
    }
  if (first > 0) return;
  for (std::uint32_t k = 0; k < 6; ++k) std::fill_n(places + k * std::size_t{layout.stride}, layout.padding, Real(0));
}

template <class Real>
void SpringSums<Real>::run(const Layout& layout, std::uint32_t row_block, std::uint32_t column_block, Real* places,
                           double* sums) const {
  const std::size_t vector = 3 * std::size_t{layout.stride};
  Real* const half_displacement = places + vector;
  const std::uint32_t row = layout.begin_of(row_block), column = layout.begin_of(column_block);
  sum_tile_({.row_position = places + row,
             .row_half_displacement = half_displacement + row,
             .column_position = places + column,
             .column_half_displacement = half_displacement + column,
             .row_sum = sums + column_block * vector + row,
             .column_sum = sums + row_block * vector + column,
             .stride = layout.stride,
             .row_count = layout.begin_of(row_block + 1) - row,
             .column_count = layout.begin_of(column_block + 1) - column,
             .padding = row == 0 ? layout.padding : 0});
}

template <class Real>
void SpringSums<Real>::unpack(const SpringBody<Real>& body, const Layout& layout, std::uint32_t first, std::uint32_t end,
                              const double* sums) {
  const std::size_t vector = 3 * std::size_t{layout.stride};
  for (std::uint32_t i = first; i < end; ++i) {
    const double* sum = sums + layout.padding + i;
    glm::dvec3 total(0.0);
    for (std::uint32_t block = 0; block < layout.block_count; ++block, sum += vector)
      total += glm::dvec3(sum[0], sum[layout.stride], sum[2 * std::size_t{layout.stride}]);
    body.sums[i - body.first_wanted] = 4.0 * total;  // because tiles sum quarters
  }
}

template class SpringSums<float>;
template class SpringSums<double>;

}  // namespace pliant::cpu
