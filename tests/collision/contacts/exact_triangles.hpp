// Oracles for triangle tests: an exact answer on integer coordinates, and the distance in fp64.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace pliant::testing {

using Lattice3 = glm::vec<3, std::int64_t>;
using LatticeTriangle = std::array<Lattice3, 3>;
using Triangle = std::array<glm::vec3, 3>;

/// Do the closed triangles (or segments, or points, where corners coincide) share a point? Exact for |coordinates| up to 2^22.
[[nodiscard]] bool exactly_touch(const LatticeTriangle& a, const LatticeTriangle& b);

/// Distance between triangles that do not touch, over their largest extent along an axis.
[[nodiscard]] double relative_gap(const Triangle& a, const Triangle& b);

}  // namespace pliant::testing
