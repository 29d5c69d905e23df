// Sums the springs of a leaf of a clustered body, a vertex in each lane, once for each instruction set. Files that include this
// header are compiled for different processors. So it holds only declarations: a linker could take an inline function from the
// wrong file.
#pragma once
#include <cstdint>

#include "device/cpu/isa.hpp"

namespace pliant::cpu {

inline constexpr unsigned leaf_lanes = 16, point_size = 8;  // vertices of a leaf, and numbers of a point

/// Nodes that one of the clusters above a leaf sees.
template <class Real>
struct SeenNodes {
  const std::uint32_t* points;
  std::uint32_t count;
  std::uint32_t stride;  // from what the leaf keeps for one node to what it keeps for the next [numbers]
  Real* pulls;           // out: three numbers for each node
};

/// Points have point_size numbers: place, how many vertices it stands for, displacement, 0 (physics/forces/clusters.glsl).
template <class Real>
struct LeafSprings {
  const Real* points;
  std::uint32_t leaf;                // whose vertices these are
  const std::uint32_t* near_leaves;  // whose vertices they see
  std::uint32_t near_count;
  const SeenNodes<Real>* seen;  // by the leaf and by each cluster above
  std::uint32_t seen_count;
  Real* pulls;  // out: [vertex][3]
};

template <class Real>
using LeafFunction = void (*)(const LeafSprings<Real>&);

/// Returns the function of an instruction set that is available.
template <class Real>
[[nodiscard]] LeafFunction<Real> leaf_function(Isa isa);

void sum_leaf_portable(const LeafSprings<float>& leaf);
void sum_leaf_portable(const LeafSprings<double>& leaf);
void sum_leaf_avx2(const LeafSprings<float>& leaf);
void sum_leaf_avx2(const LeafSprings<double>& leaf);
void sum_leaf_avx512(const LeafSprings<float>& leaf);
void sum_leaf_avx512(const LeafSprings<double>& leaf);

}  // namespace pliant::cpu
