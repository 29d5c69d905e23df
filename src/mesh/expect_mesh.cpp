#include "mesh/expect_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "mesh/obj.hpp"

namespace pliant {
namespace {

void expect_positions(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) throw Error(ErrorKind::input, "", "the mesh has no vertices", "give it a surface");
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(positions[v][k]) <= max_coordinate))
        throw Error(ErrorKind::input, "", fmt::format("vertex {} has the coordinate {}", v, positions[v][k]),
                    fmt::format("use finite numbers up to {}", max_coordinate));
}

}  // namespace

void expect_mesh(const TriangleMesh& mesh) {
  expect_positions(mesh.positions);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    for (const std::uint32_t corner : mesh.triangles[t])
      if (corner >= mesh.positions.size())
        throw Error(ErrorKind::input, "",
                    fmt::format("triangle {} names vertex {}, but the mesh has {} vertices", t, corner, mesh.positions.size()),
                    "count vertices from 0");
    if (a == b || b == c || c == a)
      throw Error(ErrorKind::input, "", fmt::format("triangle {} names a vertex twice", t), "leave the triangle out");
  }
}

}  // namespace pliant
