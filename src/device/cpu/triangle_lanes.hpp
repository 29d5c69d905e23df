// Tests pairs of triangles side by side, a pair in each lane of a vector, once for each instruction set. The test is that of
// physics/collision/certified_triangles.glsl. Files that include this header are compiled for different processors. So it holds
// only declarations: a linker could take an inline function from the wrong file.
#pragma once
#include <cstdint>

namespace pliant::cpu {

inline constexpr unsigned most_lanes = 16;

struct TriangleLanes {
  alignas(64) float corner[2][3][3][most_lanes];  // [triangle of the pair][corner][x, y, z][pair] [any unit]
};

/// A bit for each pair. A pair without any is apart.
struct LaneAnswers {
  std::uint32_t touching;  // triangles_may_touch() says so
  std::uint32_t unknown;   // it has to be asked: the pair is nearly in one plane, without area, not finite, or out of range
};

/// Answers for the first `count` pairs, and perhaps for more. Every set gives the same answers.
using LaneTest = LaneAnswers (*)(const TriangleLanes& pairs, unsigned count);

LaneAnswers test_lanes_portable(const TriangleLanes& pairs, unsigned count);
LaneAnswers test_lanes_avx2(const TriangleLanes& pairs, unsigned count);
LaneAnswers test_lanes_avx512(const TriangleLanes& pairs, unsigned count);

}  // namespace pliant::cpu
