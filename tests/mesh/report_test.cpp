#include "mesh/report.hpp"

#include <catch2/catch.hpp>

#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "support/json.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

/// A closed ring of `around` times `across` quads. Every quad is split in two.
TriangleMesh torus(std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 6.283185307179586 * i / around, v = 6.283185307179586 * j / across;
      const double ring = 2 + std::cos(v);
      mesh.positions.emplace_back(ring * std::cos(u), ring * std::sin(u), std::sin(v));
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return (a % around) * across + b % across; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other, const glm::dvec3& shift) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p : other.positions) mesh.positions.push_back(p + shift);
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

TEST_CASE("a torus has one handle") {
  const MeshReport report = report_mesh(torus(20, 10));
  CHECK((report.closed && report.manifold));
  CHECK(report.euler_characteristic == 0);
  CHECK(report.genus == 1);
  CHECK(report.edge_count == 3 * report.vertex_count);
}

TEST_CASE("separate parts are counted, and their handles are summed") {
  TriangleMesh mesh = torus(12, 8);
  append(mesh, torus(9, 7), {10, 0, 0});
  append(mesh, generate_mesh("icosphere:1"), {0, 10, 0});
  const MeshReport report = report_mesh(mesh);
  CHECK(report.component_count == 3);
  CHECK(report.genus == 2);
}

TEST_CASE("volume and area scale with the cube and the square, and volume ignores where the mesh is") {
  TriangleMesh mesh = torus(20, 10);
  const MeshReport before = report_mesh(mesh);
  for (glm::dvec3& p : mesh.positions) p = 3.0 * p + glm::dvec3(1000, -500, 250);
  const MeshReport after = report_mesh(mesh);
  REQUIRE((before.volume && after.volume));
  CHECK(*after.volume == Approx(27 * *before.volume));
  CHECK(after.area == Approx(9 * before.area));
}

TEST_CASE("turning a mesh inside out changes the sign of its volume alone") {
  TriangleMesh mesh = generate_mesh("icosphere:2");
  const MeshReport before = report_mesh(mesh);
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  const MeshReport after = report_mesh(mesh);
  CHECK(*before.volume > 0);
  CHECK(*after.volume == Approx(-*before.volume));
  CHECK(after.area == Approx(before.area));
}

TEST_CASE("a missing triangle leaves three boundary edges and no volume") {
  TriangleMesh mesh = generate_mesh("icosphere:1");
  mesh.triangles.pop_back();
  const MeshReport report = report_mesh(mesh);
  CHECK(report.boundary_edge_count == 3);
  CHECK_FALSE(report.closed);
  CHECK(report.manifold);
  CHECK_FALSE(report.volume);
  CHECK_FALSE(report.genus);
}

TEST_CASE("a triangle turned over leaves three edges that wind inconsistently") {
  TriangleMesh mesh = generate_mesh("icosphere:1");
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.inconsistent_edge_count == 3);
  CHECK(report.closed);
  CHECK_FALSE(report.volume);
}

TEST_CASE("a third triangle at an edge makes it non-manifold") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const MeshReport report = report_mesh(mesh);
  CHECK(report.non_manifold_edge_count == 1);
  CHECK(report.inconsistent_edge_count == 1);
  CHECK(report.boundary_edge_count == 6);
  CHECK_FALSE(report.manifold);
}

TEST_CASE("two fans that meet in one vertex make it non-manifold") {
  TriangleMesh mesh = generate_mesh("icosphere:0");
  const std::uint32_t shared = 0;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  append(mesh, generate_mesh("icosphere:0"), {5, 0, 0});
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& vertex : triangle)
      if (vertex == first) vertex = shared;
  const MeshReport report = report_mesh(mesh);
  CHECK(report.closed);
  CHECK(report.non_manifold_edge_count == 0);
  CHECK(report.non_manifold_vertex_count == 1);
  CHECK_FALSE(report.genus);
}

TEST_CASE("collinear and repeated corners have no area at any size, thin triangles do") {
  for (const double size : {1e-200, 1e-3, 1.0, 1e8}) {
    CAPTURE(size);
    const TriangleMesh mesh{
        {{0, 0, 0}, {0.1 * size, 0.2 * size, 0.3 * size}, {0.3 * size, 0.6 * size, 0.9 * size}, {0, 1e-6 * size, 0}},
        {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}}};
    CHECK(count_zero_area_triangles(mesh) == 2);
  }
}

TEST_CASE("the bunny is closed, manifold and of genus 0") {
  const MeshReport report = report_mesh(load_obj(source_dir() + "/meshes/bunny.obj").mesh);
  CHECK((report.closed && report.manifold && report.genus == 0 && report.component_count == 1));
  CHECK(*report.volume > 0);
}

TEST_CASE("a mesh without triangles can be reported") {
  const MeshReport report = report_mesh({});
  CHECK((report.vertex_count == 0 && !report.closed && !report.volume));
  CHECK_NOTHROW(to_text(report));
}

TEST_CASE("the JSON report holds the report's numbers, and null where there is none") {
  TriangleMesh mesh = generate_mesh("icosphere:1");
  const MeshReport report = report_mesh(mesh);
  const auto json = test::ReadJson::parse(to_json(report));
  CHECK(json["vertices"] == report.vertex_count);
  CHECK(json["edges"] == report.edge_count);
  CHECK(json["closed"] == true);
  CHECK(json["genus"] == 0);
  CHECK(json["volume"] == *report.volume);
  mesh.triangles.pop_back();
  CHECK(test::ReadJson::parse(to_json(report_mesh(mesh)))["volume"].is_null());
}

}  // namespace pliant
