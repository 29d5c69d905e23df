#include "collision/contacts/degenerate_cases.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/paths.hpp"

namespace pliant::testing {
namespace {

using nlohmann::json;

json read_cases() { return json::parse(std::ifstream(source_dir() + "/tests/collision/contacts/degenerate.json")); }

float number(const json& value) { return value.is_string() ? std::stof(value.get<std::string>()) : value.get<float>(); }
glm::vec3 point(const json& value) { return {number(value[0]), number(value[1]), number(value[2])}; }
Triangle triangle(const json& value) { return {point(value[0]), point(value[1]), point(value[2])}; }

void add_cube(Model& model, const json& vertices, const json& faces) {
  ModelBody body;
  body.first_vertex = model.vertex_count();
  body.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  body.vertex_count = static_cast<std::uint32_t>(vertices.size());
  body.triangle_count = static_cast<std::uint32_t>(faces.size());
  for (const json& vertex : vertices) model.rest_positions.emplace_back(point(vertex), static_cast<float>(model.bodies.size()));
  for (const json& face : faces) {
    auto corners = face.get<std::array<std::uint32_t, 3>>();
    for (std::uint32_t& corner : corners) corner += body.first_vertex;
    model.triangles.push_back(corners);
  }
  model.bodies.push_back(body);
}

}  // namespace

std::vector<TrianglePair> triangle_pairs() {
  const json cases = read_cases();
  std::vector<TrianglePair> pairs;
  for (const json& entry : cases.at("pairs")) {
    const json& expect = entry.at("expect");
    pairs.push_back({entry.at("id"), entry.at("category"), triangle(entry.at("tri0")), triangle(entry.at("tri1")),
                     expect.is_null() ? std::nullopt : std::optional<bool>(expect.get<bool>())});
  }
  return pairs;
}

std::vector<CubePair> cube_pairs() {
  const json cases = read_cases();
  std::vector<CubePair> pairs;
  for (const json& entry : cases.at("mesh_cases")) {
    CubePair pair{entry.at("id"), {}, {}};
    add_cube(pair.model, entry.at("verts0"), cases.at("cube_faces"));
    add_cube(pair.model, entry.at("verts1"), cases.at("cube_faces"));
    for (const json& touching : entry.at("pairs")) {
      pair.pairs.emplace_back(touching[0].get<unsigned>(), 12u + touching[1].get<unsigned>());
    }
    std::sort(pair.pairs.begin(), pair.pairs.end(), [](auto p, auto q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace pliant::testing
