#include "mesh/subdivide.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "mesh/edges.hpp"
#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "mesh/report.hpp"
#include "support/expect_error.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

constexpr Subdivision schemes[] = {Subdivision::midpoint, Subdivision::loop};

std::vector<TriangleMesh> sample_meshes() {
  return {generate_mesh("icosphere:1"), generate_mesh("cube:2"),        generate_mesh("ring:0.3,12"),
          generate_mesh("bowl:3"),      generate_mesh("crate:2,1,1,4"), load_obj(source_dir() + "/meshes/teapot.obj").mesh};
}

glm::dvec3 normal_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
}

/// A flat patch of n by n squares, each halved by a diagonal, in the plane of all points p with z = slope . p.
TriangleMesh sloped_patch(unsigned n, const glm::dvec3& slope) {
  TriangleMesh mesh;
  for (unsigned row = 0; row <= n; ++row)
    for (unsigned column = 0; column <= n; ++column) mesh.positions.emplace_back(row, column, slope.x * row + slope.y * column);
  for (unsigned row = 0; row < n; ++row)
    for (unsigned column = 0; column < n; ++column) {
      const std::uint32_t a = row * (n + 1) + column, b = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    }
  return mesh;
}

std::set<std::uint32_t> boundary_of(const TriangleMesh& mesh) {
  const Edges edges = find_edges(mesh);
  std::vector<int> sides(edges.count(), 0);
  for (const std::uint32_t edge : edges.of_side) ++sides[edge];
  std::set<std::uint32_t> boundary;
  for (std::size_t edge = 0; edge < edges.count(); ++edge)
    if (const std::uint32_t side = edges.first_side[edge]; sides[edge] == 1)
      boundary.insert({start_of_side(mesh, side), start_of_side(mesh, next_side(side))});
  return boundary;
}

double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, glm::distance(a[i], b[i]));
  return largest;
}

}  // namespace

TEST_CASE("no subdivision leaves a mesh as it is") {
  const TriangleMesh mesh = generate_mesh("bowl:3");
  for (const Subdivision scheme : schemes) {
    CHECK(subdivide(mesh, 0, scheme).positions == mesh.positions);
    CHECK(subdivide(mesh, 0, scheme).triangles == mesh.triangles);
  }
}

TEST_CASE("a subdivision adds a vertex for each edge and makes four triangles of each") {
  for (const TriangleMesh& mesh : sample_meshes())
    for (const Subdivision scheme : schemes) {
      const MeshReport coarse = report_mesh(mesh), fine = report_mesh(subdivide(mesh, 1, scheme));
      CHECK(fine.vertex_count == coarse.vertex_count + coarse.edge_count);
      CHECK(fine.triangle_count == 4 * coarse.triangle_count);
      CHECK(fine.edge_count == 2 * coarse.edge_count + 3 * coarse.triangle_count);
      CHECK(fine.euler_characteristic == coarse.euler_characteristic);
      CHECK(fine.boundary_edge_count == 2 * coarse.boundary_edge_count);
      CHECK(fine.component_count == coarse.component_count);
      CHECK((fine.closed == coarse.closed && fine.manifold == coarse.manifold && fine.genus == coarse.genus));
      CHECK(fine.inconsistent_edge_count == 2 * coarse.inconsistent_edge_count);
    }
}

TEST_CASE("two subdivisions are one after the other") {
  const TriangleMesh mesh = generate_mesh("bowl:3");
  for (const Subdivision scheme : schemes) {
    const TriangleMesh at_once = subdivide(mesh, 2, scheme), in_turn = subdivide(subdivide(mesh, 1, scheme), 1, scheme);
    CHECK(at_once.positions == in_turn.positions);
    CHECK(at_once.triangles == in_turn.triangles);
  }
}

TEST_CASE("a subdivision by midpoints keeps vertices, area, volume and the bounding box") {
  for (const TriangleMesh& mesh : sample_meshes()) {
    const TriangleMesh fine = subdivide(mesh, 2);
    CHECK(largest_distance(fine.positions, mesh.positions, mesh.positions.size()) == 0);
    const MeshReport before = report_mesh(mesh), after = report_mesh(fine);
    CHECK(after.area == Approx(before.area).epsilon(1e-12));
    CHECK((after.lowest == before.lowest && after.highest == before.highest));
    REQUIRE(after.volume.has_value() == before.volume.has_value());
    if (before.volume) CHECK(*after.volume == Approx(*before.volume).epsilon(1e-12));
  }
}

TEST_CASE("triangle t becomes 4 t to 4 t + 3, which wind as it did") {
  const TriangleMesh mesh = generate_mesh("ring:0.3,12");
  const TriangleMesh fine = subdivide(mesh, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(fine.triangles[4 * t + k][0] == mesh.triangles[t][k]);
    for (std::size_t k = 0; k < 4; ++k) CHECK(glm::distance(4.0 * normal_of(fine, 4 * t + k), normal_of(mesh, t)) < 1e-14);
  }
}

TEST_CASE("a plane stays a plane") {
  const glm::dvec3 slope(0.25, -0.5, 0);
  for (const Subdivision scheme : schemes)
    for (const glm::dvec3& p : subdivide(sloped_patch(3, slope), 2, scheme).positions)
      CHECK(p.z == Approx(slope.x * p.x + slope.y * p.y).margin(1e-14));
}

TEST_CASE("on a regular flat patch Loop's scheme places vertices where midpoints are, but for the patch's corners") {
  const TriangleMesh patch = sloped_patch(4, {0.25, -0.5, 0});
  const TriangleMesh smooth = subdivide(patch, 1, Subdivision::loop), flat = subdivide(patch, 1);
  CHECK(smooth.triangles == flat.triangles);
  const std::set<std::size_t> corners = {0, 4, 20, 24};
  for (std::size_t i = 0; i < flat.positions.size(); ++i)
    CHECK((glm::distance(smooth.positions[i], flat.positions[i]) < 1e-14) == !corners.contains(i));
}

// Sums over the neighbours of a vertex of an icosahedron are sqrt(5) times the vertex. So its limit is a multiple of it, by the
// mask of limits in Loop's thesis.
TEST_CASE("Loop's scheme brings an icosahedron's vertices to their limits") {
  const double x = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / 5), weight = (0.625 - x * x) / 5;
  const double limit_weight = 1 / (3 / (8 * weight) + 5);
  const double limit = 1 + limit_weight * (std::sqrt(5.0) - 5);
  const TriangleMesh icosahedron = generate_mesh("icosphere:0");
  double before = 1 - limit;
  for (unsigned n = 1; n <= 5; ++n) {
    const TriangleMesh smooth = subdivide(icosahedron, n, Subdivision::loop);
    double largest = 0;
    for (std::size_t i = 0; i < 12; ++i)
      largest = std::max(largest, glm::distance(smooth.positions[i], limit * icosahedron.positions[i]));
    CHECK(largest < 0.3 * before);
    before = largest;
  }
  CHECK(before < 1e-3);
}

TEST_CASE("Loop's scheme makes nearly a sphere of an icosahedron") {
  const TriangleMesh smooth = subdivide(generate_mesh("icosphere:0"), 4, Subdivision::loop);
  double least = 1, most = 0;
  for (const glm::dvec3& p : smooth.positions) {
    least = std::min(least, glm::length(p));
    most = std::max(most, glm::length(p));
  }
  CHECK(most / least < 1.02);
  for (std::size_t t = 0; t < smooth.triangles.size(); ++t)
    REQUIRE(glm::dot(normal_of(smooth, t), smooth.positions[smooth.triangles[t][0]]) > 0);
}

TEST_CASE("with Loop's scheme a boundary depends on itself alone, and is a cubic B-spline") {
  TriangleMesh bowl = generate_mesh("bowl:3");
  const TriangleMesh before = subdivide(bowl, 2, Subdivision::loop);
  const std::set<std::uint32_t> rim = boundary_of(bowl), fine_rim = boundary_of(before);
  REQUIRE(fine_rim.size() == 4 * rim.size());
  for (const std::uint32_t vertex : fine_rim) CHECK(std::abs(before.positions[vertex].y) < 1e-15);  // the rim's plane
  for (std::uint32_t vertex = 0; vertex < bowl.positions.size(); ++vertex)
    if (!rim.contains(vertex)) bowl.positions[vertex] *= 3;
  const TriangleMesh after = subdivide(bowl, 2, Subdivision::loop);
  for (const std::uint32_t vertex : fine_rim) CHECK(after.positions[vertex] == before.positions[vertex]);

  const TriangleMesh triangle{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}};  // its boundary is all of it
  const std::vector<glm::dvec3> spline = {{1, 1, 0}, {6, 1, 0}, {1, 6, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  CHECK(largest_distance(subdivide(triangle, 1, Subdivision::loop).positions, spline, 6) < 1e-14);
}

TEST_CASE("with Loop's scheme an edge of three triangles is a crease") {
  const TriangleMesh leaves{{{0, 0, 0}, {0, 0, 2}, {1, 0, 1}, {-1, 2, 1}, {-1, -2, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const TriangleMesh fine = subdivide(leaves, 1, Subdivision::loop);
  CHECK((fine.positions[0] == leaves.positions[0] && fine.positions[1] == leaves.positions[1]));
  CHECK(fine.positions[5] == glm::dvec3(0, 0, 1));  // of the first edge
}

TEST_CASE("a triangle that names a vertex twice gets no vertex where it has no side") {
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 0, 1}}};
  for (const Subdivision scheme : schemes) {
    const TriangleMesh fine = subdivide(mesh, 1, scheme);
    CHECK(fine.positions.size() == 6);
    CHECK(fine.triangles.size() == 8);
    CHECK(fine.triangles[4] == std::array<std::uint32_t, 3>{0, 0, 3});
  }
}

TEST_CASE("too many subdivisions are an input error that says how many there may be") {
  const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const Error error = error_of([&] { return subdivide(tetrahedron, 15); });  // 2 * 4^n + 2 vertices and 4^(n + 1) triangles
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"15 subdivisions of 4 vertices make more than 715827882 vertices", "subdivide 14 times at most"});
  check_says(error_of([&] { return subdivide(generate_mesh("icosphere:6"), 4000000000); }), {"subdivide 7 times at most"});
}

}  // namespace pliant
