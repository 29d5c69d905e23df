#include "collision/contacts/degenerate_cases.hpp"

#include <algorithm>

#include "core/read_text.hpp"
#include "support/json.hpp"
#include "support/paths.hpp"

namespace pliant::testing {
namespace {

using test::ReadJson;

ReadJson read_cases() { return ReadJson::parse(read_text(source_dir() + "/tests/collision/contacts/degenerate.json")); }

float number(const ReadJson& value) {
  return value.is_string() ? std::stof(value.get<std::string>()) : static_cast<float>(value.get<double>());
}
glm::vec3 point(const ReadJson& value) { return {number(value[0]), number(value[1]), number(value[2])}; }
Triangle triangle(const ReadJson& value) { return {point(value[0]), point(value[1]), point(value[2])}; }

void add_cube(Model& model, const ReadJson& vertices, const ReadJson& faces) {
  ModelBody body;
  body.first_vertex = model.vertex_count();
  body.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  body.vertex_count = static_cast<std::uint32_t>(vertices.size());
  body.triangle_count = static_cast<std::uint32_t>(faces.size());
  for (const ReadJson& vertex : vertices)
    model.rest_positions.emplace_back(point(vertex), static_cast<float>(model.bodies.size()));
  for (const ReadJson& face : faces) {
    const auto corner = [&](std::size_t i) { return body.first_vertex + face[i].get<std::uint32_t>(); };
    model.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  model.bodies.push_back(body);
}

}  // namespace

std::vector<TrianglePair> triangle_pairs() {
  const ReadJson cases = read_cases();
  std::vector<TrianglePair> pairs;
  for (const ReadJson& entry : cases["pairs"]) {
    const ReadJson expect = entry["expect"];
    pairs.push_back({entry["id"].get<std::string>(), entry["category"].get<std::string>(), triangle(entry["tri0"]),
                     triangle(entry["tri1"]), expect.is_null() ? std::nullopt : std::optional<bool>(expect.get<bool>())});
  }
  return pairs;
}

std::vector<CubePair> cube_pairs() {
  const ReadJson cases = read_cases();
  std::vector<CubePair> pairs;
  for (const ReadJson& entry : cases["mesh_cases"]) {
    CubePair pair{entry["id"].get<std::string>(), {}, {}};
    add_cube(pair.model, entry["verts0"], cases["cube_faces"]);
    add_cube(pair.model, entry["verts1"], cases["cube_faces"]);
    for (const ReadJson& touching : entry["pairs"]) {
      pair.pairs.emplace_back(touching[0].get<std::uint32_t>(), 12u + touching[1].get<std::uint32_t>());
    }
    std::sort(pair.pairs.begin(), pair.pairs.end(), [](auto p, auto q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace pliant::testing
