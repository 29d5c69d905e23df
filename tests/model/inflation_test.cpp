// Which meshes and starts pressure takes.
#include "model/inflation.hpp"

#include <glm/geometric.hpp>

#include "support/evolve.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

TriangleMesh tetrahedron(double size, const glm::dvec3& corner = glm::dvec3(0.0)) {
  TriangleMesh mesh{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (glm::dvec3& position : mesh.positions) position += corner;
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

TriangleMesh both_of(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  return mesh;
}

BodySetup inflated(TriangleMesh mesh) {
  BodySetup setup = body_of_mesh(std::move(mesh));
  setup.description.pressure = 5;
  return setup;
}

// The part of the force that does not cancel, if the pressure is 1 [mesh units^2].
double sum_of_areas(const TriangleMesh& mesh) {
  glm::dvec3 sum(0.0);
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]) / 2.0;
  return glm::length(sum);
}

TEST_CASE("pressure takes no open mesh, and advises to weld one that is not welded") {
  TriangleMesh open = tetrahedron(1);
  open.triangles.pop_back();
  BodySetup setup = inflated(open);
  check_says(error_of([&] { return built(setup); }), {"3 edges have only one triangle", "such as weld = 1e-6"});
  setup.description.weld = 1e-6;
  CHECK_THAT(error_of([&] { return built(setup); }).what(), !Catch::Contains("weld vertices"));
}

TEST_CASE("pressure takes no mesh whose areas do not cancel, though no edge has a triangle alone") {
  TriangleMesh shared = tetrahedron(1);
  shared.positions.emplace_back(-1, 0, 0);
  for (const auto& [a, b, c] : {std::array{3u, 2u, 4u}, {0u, 3u, 4u}, {2u, 0u, 4u}}) shared.triangles.push_back({a, b, c});
  REQUIRE(sum_of_areas(shared) == Approx(0.5));
  check_says(error_of([&] { return built(inflated(shared)); }), {"3 edges", "forward as backward", "remove faces between"});

  TriangleMesh joined = shared;
  joined.triangles.erase(joined.triangles.begin() + 2);  // the shared face
  REQUIRE(sum_of_areas(joined) < 1e-12);
  CHECK(built(inflated(joined)).model.bodies.front().inflation.rest_volume == Approx(1 / 3.0));
  TriangleMesh doubled = shared;
  doubled.triangles.push_back({0, 2, 3});
  REQUIRE(sum_of_areas(doubled) < 1e-12);
  CHECK(built(inflated(doubled)).model.bodies.front().inflation.rest_volume == Approx(1 / 3.0));
}

TEST_CASE("pressure takes no mesh with a part wound inward, at whatever place") {
  const TriangleMesh large = tetrahedron(2);
  CHECK_NOTHROW(built(inflated(both_of(large, tetrahedron(1, {5, 0, 0})))));
  for (const glm::dvec3& place : {glm::dvec3(5, 0, 0), glm::dvec3(-1000, 3, 7), glm::dvec3(0.1, 0.1, 0.1)})
    check_says(error_of([&] { return built(inflated(both_of(large, inside_out(tetrahedron(1, place))))); }),
               {"counter-clockwise", "1 of 2 closed parts", "turn all triangles of these parts", "cavities"});
  check_says(error_of([&] {
               return built(inflated(both_of(tetrahedron(1), inside_out(tetrahedron(2, {5, 0, 0})))));
             }),
             {"1 of 2 closed parts"});

  TriangleMesh touching = both_of(large, inside_out(tetrahedron(1)));  // share vertex 0
  for (auto& triangle : touching.triangles)
    for (std::uint32_t& vertex : triangle) vertex = vertex == 4 ? 0 : vertex;
  check_says(error_of([&] { return built(inflated(touching)); }), {"1 of 2 closed parts"});
}

TEST_CASE("pressure takes no mesh so flat that rounded positions enclose nothing, and bounds the step of all others") {
  int flat = 0;
  for (const double thickness : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 1e-4, 1e-2}) {
    CAPTURE(thickness);
    BodySetup setup = inflated(generate_mesh("icosphere:1"));
    for (glm::dvec3& p : setup.mesh.positions)
      p = p.x * glm::normalize(glm::dvec3(1, 2, 2)) + p.y * glm::normalize(glm::dvec3(2, 1, -2)) +
          thickness * p.z * glm::normalize(glm::dvec3(-2, 2, -1));
    if (thickness < 2.5e-7) {
      ++flat;
      check_says(error_of([&] { return built(setup); }), {"flat", "thicker mesh"});
    } else {
      const double bound = step_bound(find_integrator("cv8"), built(setup).model.bodies.front(), DampingLaw::none);
      CHECK((bound > 0 && std::isfinite(bound)));
    }
  }
  CHECK(flat == 5);
}

TEST_CASE("a body with pressure has to start with a volume") {
  for (const PressureLaw law : {PressureLaw::gas, PressureLaw::constant})
    for (const glm::dvec3& stretch :
         {glm::dvec3(-1, 1, 1), glm::dvec3(1, 1, 0), glm::dvec3(-1, -1, -1), glm::dvec3(1, 1e-9, 1)}) {
      BodySetup setup = inflated(generate_mesh("icosphere:1"));
      setup.description.name = "balloon";
      setup.description.pressure_law = law;
      setup.description.stretch = stretch;
      check_says(error_of([&] { return built(setup); }), {"balloon", "of its rest volume", "stretch above zero"});
      setup.description.pressure = 0;
      CHECK_NOTHROW(built(setup));
    }
  BodySetup turned = inflated(generate_mesh("icosphere:1"));
  turned.description.stretch = {-1, -1, 1};  // a half turn
  CHECK_NOTHROW(built(turned));
}

}  // namespace
}  // namespace pliant
