// Meshes that a program made.
#include "mesh/expect_mesh.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "mesh/generators.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

void check_refused(const TriangleMesh& mesh, const char* part) {
  check_says(error_of([&] {
               expect_mesh(mesh);
               return 0;
             }),
             {part});
}

TEST_CASE("a mesh that a program made needs vertices, finite places, and triangles among them") {
  const TriangleMesh good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}}};  // the last vertex is in no triangle
  expect_mesh(good);
  expect_mesh(generate_mesh("icosphere:2"));
  expect_mesh({good.positions, {}});
  check_refused({}, "no vertices");
  TriangleMesh mesh = good;
  mesh.triangles.push_back({0, 1, 4});
  check_refused(mesh, "triangle 1 names vertex 4, but the mesh has 4 vertices");
  mesh.triangles.back() = {2, 0, 2};
  check_refused(mesh, "triangle 1 names a vertex twice");
  for (const double wrong : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), -1.1e9}) {
    mesh = good;
    mesh.positions[3].y = wrong;
    check_refused(mesh, "vertex 3 has the coordinate");
  }
}

}  // namespace
}  // namespace pliant
