#include "mesh/generators.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/report.hpp"
#include "support/expect_error.hpp"

namespace pliant {

TEST_CASE("an icosphere has 10 * 4^n + 2 vertices on the unit sphere and no defect") {
  for (int n = 0; n <= 5; ++n) {
    CAPTURE(n);
    const TriangleMesh mesh = generate_mesh("icosphere:" + std::to_string(n));
    const MeshReport report = report_mesh(mesh);
    CHECK(report.vertex_count == 10u * (1u << (2 * n)) + 2);
    CHECK(report.triangle_count == 20u * (1u << (2 * n)));
    CHECK((report.closed && report.manifold && report.genus == 0 && report.component_count == 1));
    CHECK((report.inconsistent_edge_count == 0 && report.duplicate_position_count == 0 && report.zero_area_triangle_count == 0));
    double largest_error = 0;
    for (const glm::dvec3& p : mesh.positions) largest_error = std::max(largest_error, std::abs(glm::length(p) - 1));
    CHECK(largest_error < 4e-16);
  }
}

TEST_CASE("an icosphere may be dense") {
  const TriangleMesh mesh = generate_mesh("icosphere:8");
  CHECK((mesh.positions.size() == 655362 && mesh.triangles.size() == 1310720));
}

TEST_CASE("an icosphere's triangles wind counter-clockwise seen from outside") {
  const TriangleMesh mesh = generate_mesh("icosphere:3");
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 normal = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    REQUIRE(glm::dot(normal, mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) > 0);
  }
}

TEST_CASE("an icosphere's volume and area approach the sphere's with the square of the edge") {
  const auto missing = [](const char* description) {
    const MeshReport report = report_mesh(generate_mesh(description));
    return std::array{4 * std::numbers::pi / 3 - *report.volume, 4 * std::numbers::pi - report.area};
  };
  const auto coarse = missing("icosphere:3"), fine = missing("icosphere:4");
  CHECK(coarse[0] / fine[0] == Approx(4).epsilon(0.02));
  CHECK(coarse[1] / fine[1] == Approx(4).epsilon(0.02));
}

TEST_CASE("the icosahedron's corners are the cyclic permutations of (0, +-1, +-golden ratio)") {
  for (const glm::dvec3& p : generate_mesh("icosphere:0").positions) {
    int zero = 0;
    while (zero < 2 && p[zero] != 0) ++zero;
    REQUIRE(p[zero] == 0);
    CHECK(std::abs(p[(zero + 2) % 3] / p[(zero + 1) % 3]) == Approx(std::numbers::phi));
  }
}

TEST_CASE("an unknown generator or a bad argument is an input error that lists what exists") {
  for (const char* description : {"cube:0", "cube:101", "cube:", "tub:3", "icosphere:", "icosphere:10", "icosphere:-1",
                                  "icosphere:2.5", "icosphere:two", "icosphere:3 ", "icosphere:99999999999", "icosphere"}) {
    CAPTURE(description);
    const Error error = error_of([&] { return generate_mesh(description); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {description, description[0] == 'c' ? "cube:n" : "icosphere:n"});
  }
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c])) / 6;
  return volume;
}

TEST_CASE("a cube is closed, of side 1, and has each vertex once") {
  for (const int n : {1, 2, 10}) {
    const TriangleMesh mesh = generate_mesh("cube:" + std::to_string(n));
    CHECK(mesh.positions.size() == static_cast<std::size_t>(6 * n * n + 2));
    CHECK(mesh.triangles.size() == static_cast<std::size_t>(12 * n * n));
    CHECK(signed_volume(mesh) == Approx(1));
  }
}

TEST_CASE("a box has its sizes, and cells that are nearly square") {
  const TriangleMesh mesh = generate_mesh("box:2,0.5,1.1,8");
  const MeshReport report = report_mesh(mesh);
  CHECK((report.closed && report.manifold && report.genus == 0 && report.component_count == 1));
  CHECK(report.inconsistent_edge_count == 0);
  CHECK(report.triangle_count == 2 * 2 * (8 * 2 + 8 * 4 + 2 * 4));
  CHECK(signed_volume(mesh) == Approx(2 * 0.5 * 1.1));
  for (const glm::dvec3& p : mesh.positions) CHECK((std::abs(p.x) <= 1 && std::abs(p.y) <= 0.25 && std::abs(p.z) <= 0.55));
}

TEST_CASE("a crate is a box without its top") {
  const MeshReport box = report_mesh(generate_mesh("box:2,0.5,1,8")), crate = report_mesh(generate_mesh("crate:2,0.5,1,8"));
  CHECK_FALSE(crate.closed);
  CHECK(crate.inconsistent_edge_count == 0);
  CHECK(crate.area == Approx(box.area - 2));
  for (const glm::dvec3& p : generate_mesh("crate:2,0.5,1,8").positions)
    CHECK((p.y < 0.25 || std::abs(p.x) == 1 || std::abs(p.z) == 0.5));
}

TEST_CASE("a bowl is the lower half of a unit sphere") {
  const TriangleMesh mesh = generate_mesh("bowl:10");
  const MeshReport report = report_mesh(mesh);
  CHECK((report.manifold && report.component_count == 1 && report.inconsistent_edge_count == 0));
  std::size_t rim = 0;
  for (const glm::dvec3& p : mesh.positions) {
    CHECK(glm::length(p) == Approx(1));
    CHECK(p.y <= 0);
    rim += p.y == 0;
  }
  CHECK(rim == 80);
  CHECK(report.area == Approx(2 * std::numbers::pi).epsilon(0.01));
  CHECK(signed_volume(mesh) == Approx(2 * std::numbers::pi / 3).epsilon(0.02));  // so it winds outward
}

TEST_CASE("a ring is a closed torus") {
  const TriangleMesh mesh = generate_mesh("ring:0.25,64");
  const MeshReport report = report_mesh(mesh);
  CHECK((report.closed && report.manifold && report.genus == 1 && report.component_count == 1));
  CHECK(report.inconsistent_edge_count == 0);
  CHECK(signed_volume(mesh) == Approx(2 * std::numbers::pi * std::numbers::pi * 0.0625).epsilon(0.03));
  for (const glm::dvec3& p : mesh.positions) CHECK(std::hypot(std::hypot(p.x, p.z) - 1, p.y) == Approx(0.25));
}

TEST_CASE("a box's sizes and cells that can't be are an input error") {
  for (const char* description :
       {"box:", "box:1,2,3", "box:1,2,3,0", "box:1,2,3,101", "box:0,2,3,4", "box:1,2,x,4", "box:1,2,3,4,5", "crate:-1,2,3,4",
        "ring:1,8", "ring:0.2", "ring:0.2,0", "bowl:0", "box:1e7,2,3,4", "box:nan,1,1,1"}) {
    CAPTURE(description);
    const Error error = error_of([&] { return generate_mesh(description); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {description, "write "});
  }
}

TEST_CASE("a generator's description is told from a path") {
  CHECK(is_generator("icosphere:3"));
  CHECK(is_generator("cube:1"));
  for (const char* path : {"bunny.obj", "../meshes/bunny.obj", "C:\\meshes\\bunny.obj", "./icosphere:3", "a:b.obj", ""}) {
    CAPTURE(path);
    CHECK_FALSE(is_generator(path));
  }
}

}  // namespace pliant
