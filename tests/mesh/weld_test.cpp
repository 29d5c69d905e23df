#include "mesh/weld.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "mesh/report.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

/// Every triangle with corners of its own, each moved by at most `jitter`.
TriangleMesh explode(const TriangleMesh& mesh, double jitter) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> offset(-jitter / std::sqrt(3.0), jitter / std::sqrt(3.0));
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t vertex : triangle)
      soup.positions.push_back(mesh.positions[vertex] + glm::dvec3(offset(random), offset(random), offset(random)));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Welds by the definition: compares every vertex with all that stay.
std::size_t count_merged_by_brute_force(const std::vector<glm::dvec3>& positions, double distance) {
  std::vector<glm::dvec3> stay;
  for (const glm::dvec3& p : positions) {
    bool merged = false;
    for (const glm::dvec3& q : stay) merged = merged || glm::distance(p, q) < distance;
    if (!merged) stay.push_back(p);
  }
  return positions.size() - stay.size();
}

}  // namespace

TEST_CASE("welding a sphere's separate triangles gives the closed sphere back") {
  const TriangleMesh sphere = generate_mesh("icosphere:2");
  const WeldedMesh welded = weld(explode(sphere, 1e-7), 1e-6);
  CHECK(welded.mesh.positions.size() == sphere.positions.size());
  CHECK(welded.merged_vertex_count == 3 * sphere.triangles.size() - sphere.positions.size());
  CHECK(welded.dropped_triangle_count == 0);
  const MeshReport report = report_mesh(welded.mesh);
  CHECK((report.closed && report.manifold && report.genus == 0));
}

TEST_CASE("welding merges what the definition says, at any distance") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 600; ++i) mesh.positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  for (std::uint32_t i = 0; i < 600; i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  for (const double distance : {1e-300, 0.01, 0.1, 0.3, 1.0, 10.0}) {
    CAPTURE(distance);
    CHECK(weld(mesh, distance).merged_vertex_count == count_merged_by_brute_force(mesh.positions, distance));
  }
}

TEST_CASE("the first of the vertices that become one keeps its position") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.05, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {3, 1, 4}}};
  const WeldedMesh welded = weld(mesh, 0.1);
  CHECK(welded.mesh.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(welded.mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 1, 3});
}

TEST_CASE("a distance of zero changes nothing, and vertices exactly the distance apart stay") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {{0, 1, 2}, {3, 1, 2}}};
  CHECK(weld(mesh, 0).mesh.positions == mesh.positions);
  CHECK(weld(mesh, 0).merged_vertex_count == 0);
  CHECK(weld(mesh, 1).merged_vertex_count == 1);
}

TEST_CASE("triangles that collapse are dropped and counted, with the vertices only they used") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {5.01, 0, 0}, {6, 0, 0}}, {{0, 1, 2}, {3, 4, 5}}};
  const WeldedMesh welded = weld(mesh, 0.1);
  CHECK(welded.dropped_triangle_count == 1);
  CHECK(welded.mesh.triangles.size() == 1);
  CHECK(welded.mesh.positions.size() == 3);
}

TEST_CASE("the teapot welds to 529 vertices and stays open") {
  const TriangleMesh teapot = load_obj(source_dir() + "/meshes/teapot.obj").mesh;
  CHECK(report_mesh(teapot).duplicate_position_count == 263);
  const MeshReport report = report_mesh(weld(teapot, 1e-6).mesh);
  CHECK(report.vertex_count == 529);
  CHECK(report.duplicate_position_count == 0);
  CHECK_FALSE(report.closed);
}

}  // namespace pliant
