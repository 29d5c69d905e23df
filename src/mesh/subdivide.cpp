#include "mesh/subdivide.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "mesh/edges.hpp"

namespace pliant {
namespace {

struct Ends {
  std::uint32_t a, b;
};

Ends ends_of(const TriangleMesh& mesh, const Edges& edges, std::size_t edge) {
  const std::uint32_t side = edges.first_side[edge];
  return {start_of_side(mesh, side), start_of_side(mesh, next_side(side))};
}

void append_midpoints(const TriangleMesh& mesh, const Edges& edges, std::vector<glm::dvec3>& positions) {
  for (std::size_t edge = 0; edge < edges.count(); ++edge) {
    const auto [a, b] = ends_of(mesh, edges, edge);
    positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
  }
}

// Sums over what stands around edges and vertices.
struct Surroundings {
  std::vector<std::uint32_t> side_count;     // [edge]
  std::vector<glm::dvec3> opposite_sum;      // [edge] of its triangles' third corners
  std::vector<std::uint32_t> valence;        // [vertex] its edges
  std::vector<glm::dvec3> neighbour_sum;     // [vertex] of their other ends
  std::vector<std::uint32_t> crease_count;   // [vertex] its creases
  std::vector<glm::dvec3> along_crease_sum;  // [vertex] of their other ends

  [[nodiscard]] bool is_crease(std::size_t edge) const { return side_count[edge] != 2; }
};

Surroundings add_up_surroundings(const TriangleMesh& mesh, const Edges& edges) {
  const std::size_t edge_count = edges.count(), vertex_count = mesh.positions.size();
  const glm::dvec3 none(0.0);
  Surroundings around{.side_count = std::vector(edge_count, 0u),
                      .opposite_sum = std::vector(edge_count, none),
                      .valence = std::vector(vertex_count, 0u),
                      .neighbour_sum = std::vector(vertex_count, none),
                      .crease_count = std::vector(vertex_count, 0u),
                      .along_crease_sum = std::vector(vertex_count, none)};
  for (std::uint32_t side = 0; side < edges.of_side.size(); ++side) {
    const std::uint32_t edge = edges.of_side[side];
    if (edge == no_edge) continue;
    ++around.side_count[edge];
    around.opposite_sum[edge] += mesh.positions[start_of_side(mesh, next_side(next_side(side)))];
  }
  for (std::size_t edge = 0; edge < edge_count; ++edge) {
    const auto [a, b] = ends_of(mesh, edges, edge);
    for (const auto& [vertex, other] : {Ends{a, b}, Ends{b, a}}) {
      ++around.valence[vertex];
      around.neighbour_sum[vertex] += mesh.positions[other];
      if (!around.is_crease(edge)) continue;
      ++around.crease_count[vertex];
      around.along_crease_sum[vertex] += mesh.positions[other];
    }
  }
  return around;
}

// Returns the weight of each neighbour of a vertex with so many of them, on a smooth surface.
double loop_weight(std::uint32_t valence) {
  const double x = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / valence);
  return (0.625 - x * x) / valence;
}

glm::dvec3 moved_by_loop(const Surroundings& around, std::uint32_t vertex, const glm::dvec3& position) {
  if (around.crease_count[vertex] == 2) return 0.75 * position + 0.125 * around.along_crease_sum[vertex];
  if (around.crease_count[vertex] != 0 || around.valence[vertex] == 0) return position;
  const double weight = loop_weight(around.valence[vertex]);
  return (1 - around.valence[vertex] * weight) * position + weight * around.neighbour_sum[vertex];
}

void place_by_loop(const TriangleMesh& mesh, const Edges& edges, std::vector<glm::dvec3>& positions) {
  const Surroundings around = add_up_surroundings(mesh, edges);
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex)
    positions[vertex] = moved_by_loop(around, vertex, mesh.positions[vertex]);
  for (std::size_t edge = 0; edge < edges.count(); ++edge) {
    const auto [a, b] = ends_of(mesh, edges, edge);
    const glm::dvec3 sum = mesh.positions[a] + mesh.positions[b];
    positions.push_back(around.is_crease(edge) ? 0.5 * sum : 0.375 * sum + 0.125 * around.opposite_sum[edge]);
  }
}

struct Size {
  std::uint64_t vertices, edges, triangles;

  [[nodiscard]] bool is_allowed() const { return vertices <= most_mesh_vertices && triangles <= most_mesh_triangles; }
  [[nodiscard]] std::uint64_t bytes() const {
    return vertices * sizeof(glm::dvec3) + triangles * sizeof(std::array<std::uint32_t, 3>);
  }
};

// Each edge falls in two, and each triangle gets three more inside.
Size subdivided(const Size& size) {
  return {size.vertices + size.edges, 2 * size.edges + 3 * size.triangles, 4 * size.triangles};
}

// Asks for twice a mesh's memory, because a copy of it stands beside it, or what it is made from.
void expect_memory(const Size& size, unsigned count) {
  if (is_memory_given(2 * size.bytes())) return;
  throw Error(ErrorKind::input, "",
              fmt::format("{} subdivisions make {} vertices and {} triangles, for which there are no {:.1f} GB of memory", count,
                          size.vertices, size.triangles, 2e-9 * static_cast<double>(size.bytes())),
              "subdivide fewer times");
}

void expect_room(const Size& now, unsigned count) {
  Size size = now;
  unsigned most = 0;
  for (unsigned i = 0; i < count; ++i) {
    size = subdivided(size);
    if (size.is_allowed()) most = i + 1;
    if (size.vertices > 1000 * most_mesh_vertices) break;  // so that numbers stay within 64 bits
  }
  if (most == count) return expect_memory(size, count);
  throw Error(ErrorKind::input, "",
              fmt::format("{} subdivisions of {} vertices make more than {} vertices or {} triangles", count, now.vertices,
                          most_mesh_vertices, most_mesh_triangles),
              most == 0 ? "take the mesh as it is" : fmt::format("subdivide {} times at most", most));
}

std::vector<std::array<std::uint32_t, 3>> split_triangles(const TriangleMesh& mesh, const Edges& edges) {
  std::vector<std::array<std::uint32_t, 3>> split;
  split.reserve(4 * mesh.triangles.size());
  const auto vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto between = [&](std::size_t k, std::uint32_t end) {
      const std::uint32_t edge = edges.of_side[3 * t + k];
      return edge == no_edge ? end : vertex_count + edge;  // a side without length has its middle where it ends
    };
    const std::uint32_t ab = between(0, a), bc = between(1, b), ca = between(2, c);
    split.insert(split.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return split;
}

TriangleMesh subdivide_once(const TriangleMesh& mesh, const Edges& edges, Subdivision scheme) {
  TriangleMesh fine;
  fine.positions.reserve(mesh.positions.size() + edges.count());
  fine.positions = mesh.positions;
  if (scheme == Subdivision::midpoint)
    append_midpoints(mesh, edges, fine.positions);
  else
    place_by_loop(mesh, edges, fine.positions);
  fine.triangles = split_triangles(mesh, edges);
  return fine;
}

}  // namespace

TriangleMesh subdivide(const TriangleMesh& mesh, unsigned count, Subdivision scheme) {
  TriangleMesh fine = mesh;
  for (unsigned i = 0; i < count; ++i) {
    const Edges edges = find_edges(fine);
    if (i == 0) expect_room({fine.positions.size(), edges.count(), fine.triangles.size()}, count);
    fine = subdivide_once(fine, edges, scheme);
  }
  return fine;
}

}  // namespace pliant
