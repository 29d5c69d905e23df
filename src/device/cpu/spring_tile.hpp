// The spring forces between two blocks of vertices, once for each instruction set. Files that include this header are compiled
// for different processors, so it holds declarations alone: no inline function that a linker could take from the wrong one.
#pragma once

namespace pliant::cpu {

/// Lengths of blocks are multiples of this.
template <class Real>
inline constexpr unsigned widest_vector = 64 / sizeof(Real);

/// Rows against columns: two blocks of one body, or one block against itself. Every pointer is to an x component; y and z stand
/// `stride` and 2 `stride` numbers behind it. Starts of rows and columns are aligned to 64 bytes. A body begins with less than a
/// vector of padding, which is zero, so that the rest are whole vectors; its first block has no columns but against itself.
template <class Real>
struct SpringTile {
  const Real* row_position;
  const Real* row_half_displacement;
  const Real* column_position;
  const Real* column_half_displacement;
  double* row_sum;     // out: sum over the columns of x times a quarter of the strain, x = x_row - x_column
  double* column_sum;  // out: the same over the rows, with the other sign; is row_sum in a block against itself
  unsigned stride;
  unsigned row_count;
  unsigned column_count;
  unsigned padding;  // of the rows, the first
};

template <class Real>
using TileFunction = void (*)(const SpringTile<Real>&);

void sum_tile_portable(const SpringTile<float>& tile);
void sum_tile_portable(const SpringTile<double>& tile);
void sum_tile_avx2(const SpringTile<float>& tile);
void sum_tile_avx2(const SpringTile<double>& tile);
void sum_tile_avx512(const SpringTile<float>& tile);
void sum_tile_avx512(const SpringTile<double>& tile);

}  // namespace pliant::cpu
