// A triangle surface: positions and the three corners of each triangle.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace pliant {

struct TriangleMesh {
  std::vector<glm::dvec3> positions;                    // [mesh units]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // vertex indices, counter-clockwise seen from outside
};

}  // namespace pliant
