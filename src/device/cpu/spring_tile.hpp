// Sums the springs between two blocks of vertices, once for each instruction set. Files that include this header are compiled for
// different processors. So it holds only declarations: a linker could take an inline function from the wrong file.
#pragma once

namespace pliant::cpu {

/// Lengths of blocks are multiples of this.
template <class Real>
inline constexpr unsigned widest_vector = 64 / sizeof(Real);

/// Rows and columns are two blocks of one body, or a block and itself. Every pointer is to an x component. y and z stand `stride`
/// and 2 `stride` numbers behind it. Starts of rows and columns are aligned to 64 bytes.
/// A body begins with padding, so that the rest are whole vectors. The padding is zero and shorter than a vector. A body's first
/// block serves as columns only against itself.
template <class Real>
struct SpringTile {
  const Real* row_position;
  const Real* row_half_displacement;
  const Real* column_position;
  const Real* column_half_displacement;
  double* row_sum;     // out: sum over the columns of x times a quarter of the strain, x = x_row - x_column
  double* column_sum;  // out: the same over the rows, with the other sign. It is row_sum in a block against itself
  unsigned stride;
  unsigned row_count;
  unsigned column_count;
  unsigned padding;  // how many rows at the beginning are padding
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
