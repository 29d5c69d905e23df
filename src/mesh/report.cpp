#include "mesh/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <vector>

#include "core/json.hpp"
#include "mesh/edges.hpp"
#include "mesh/position_hash.hpp"

namespace pliant {
namespace {

// Sets of indices that grow by joining (union-find).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t index) {
    while (parent_[index] != index) index = parent_[index] = parent_[parent_[index]];
    return index;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Calls visit(side, the first side of its edge, whether both lead the same way) for every side of an edge.
template <typename Visit>
void for_each_side(const TriangleMesh& mesh, const Edges& edges, const Visit& visit) {
  for (std::uint32_t side = 0; side < edges.of_side.size(); ++side) {
    if (edges.of_side[side] == no_edge) continue;
    const std::uint32_t first = edges.first_side[edges.of_side[side]];
    visit(side, first, start_of_side(mesh, side) == start_of_side(mesh, first));
  }
}

void count_edges(const TriangleMesh& mesh, const Edges& edges, MeshReport& report) {
  struct SideCount {
    std::uint32_t all = 0, forward = 0;
  };
  std::vector<SideCount> counts(edges.count());
  for_each_side(mesh, edges, [&](std::uint32_t side, std::uint32_t, bool forward) {
    SideCount& count = counts[edges.of_side[side]];
    ++count.all;
    count.forward += forward ? 1 : 0;
  });
  report.edge_count = edges.count();
  for (const SideCount& count : counts) {
    if (count.all == 1) ++report.boundary_edge_count;
    if (count.all > 2) ++report.non_manifold_edge_count;
    if (count.all > 1 && 2 * std::uint64_t{count.forward} != count.all) ++report.inconsistent_edge_count;
  }
}

std::size_t count_components(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::size_t count = 0;
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) count += sets.find(vertex) == vertex ? 1 : 0;
  return count;
}

/// A fan is the corners at one vertex that are joined through shared edges. Side 3 t + k begins in corner 3 t + k.
std::size_t count_non_manifold_vertices(const TriangleMesh& mesh, const Edges& edges) {
  DisjointSets fans(mesh.triangles.size() * 3);
  for_each_side(mesh, edges, [&](std::uint32_t side, std::uint32_t first, bool forward) {
    fans.join(first, forward ? side : next_side(side));
    fans.join(next_side(first), forward ? next_side(side) : side);
  });
  std::vector<std::uint32_t> fan_count(mesh.positions.size(), 0);
  for (std::uint32_t corner = 0; corner < mesh.triangles.size() * 3; ++corner)
    if (fans.find(corner) == corner) ++fan_count[start_of_side(mesh, corner)];
  return static_cast<std::size_t>(std::ranges::count_if(fan_count, [](std::uint32_t count) { return count > 1; }));
}

// Looks each vertex up in a table of those at other places. A place in the table that is taken makes it look at the next one.
std::size_t count_duplicate_positions(const TriangleMesh& mesh) {
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), none);
  std::size_t count = 0;
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    std::size_t place = hash_of(mesh.positions[vertex]) & (table.size() - 1);
    while (table[place] != none && mesh.positions[table[place]] != mesh.positions[vertex])
      place = (place + 1) & (table.size() - 1);
    if (table[place] == none)
      table[place] = vertex;
    else
      ++count;
  }
  return count;
}

struct Corners {
  glm::dvec3 a, b, c;
};

Corners corners(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}

double largest_component(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool has_zero_area(const Corners& t) {
  const double size = std::max(largest_component(t.b - t.a), largest_component(t.c - t.a));
  if (size == 0) return true;
  const glm::dvec3 ab = (t.b - t.a) / size, ac = (t.c - t.a) / size;  // squares of tiny edges would underflow
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
  return 0.5 * glm::length(glm::cross(ab, ac)) < 1e-12 * longest * longest;
}

void measure(const TriangleMesh& mesh, MeshReport& report) {
  if (mesh.positions.empty()) return;
  report.lowest = report.highest = mesh.positions[0];
  for (const glm::dvec3& p : mesh.positions) {
    report.lowest = glm::min(report.lowest, p);
    report.highest = glm::max(report.highest, p);
  }
  const glm::dvec3 centre = 0.5 * (report.lowest + report.highest);  // volumes about it lose fewer digits
  double volume = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto [a, b, c] = corners(mesh, triangle);
    report.area += 0.5 * glm::length(glm::cross(b - a, c - a));
    volume += glm::dot(a - centre, glm::cross(b - centre, c - centre)) / 6;
  }
  if (report.closed && report.inconsistent_edge_count == 0) report.volume = volume;
}

const char* yes_no(bool value) { return value ? "yes" : "no"; }

}  // namespace

std::size_t count_zero_area_triangles(const TriangleMesh& mesh) {
  return static_cast<std::size_t>(
      std::ranges::count_if(mesh.triangles, [&](const auto& triangle) { return has_zero_area(corners(mesh, triangle)); }));
}

ClosedParts count_closed_parts(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.triangles.size());
  for_each_side(mesh, find_edges(mesh), [&](std::uint32_t side, std::uint32_t first, bool) { sets.join(first / 3, side / 3); });
  struct Volume {
    double sum = 0, rounding = 0;
  };
  std::map<std::uint32_t, Volume> volumes;  // by one of the part's triangles
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t part = sets.find(t);
    const glm::dvec3 origin = mesh.positions[mesh.triangles[part][0]];  // volumes about it lose fewer digits
    auto [a, b, c] = corners(mesh, mesh.triangles[t]);
    a -= origin, b -= origin, c -= origin;
    Volume& volume = volumes[part];
    volume.sum += glm::dot(a, glm::cross(b, c));
    volume.rounding += 1e-12 * glm::length(a) * glm::length(b) * glm::length(c);
  }
  const auto is_inward = [](const auto& volume) { return volume.second.sum < -volume.second.rounding; };
  return {volumes.size(), static_cast<std::size_t>(std::ranges::count_if(volumes, is_inward))};
}

MeshReport report_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  report.vertex_count = mesh.positions.size();
  report.triangle_count = mesh.triangles.size();
  const Edges edges = find_edges(mesh);
  count_edges(mesh, edges, report);
  report.component_count = count_components(mesh);
  report.non_manifold_vertex_count = count_non_manifold_vertices(mesh, edges);
  report.duplicate_position_count = count_duplicate_positions(mesh);
  report.zero_area_triangle_count = count_zero_area_triangles(mesh);
  report.closed = report.boundary_edge_count == 0 && report.triangle_count > 0;
  report.manifold = report.non_manifold_edge_count == 0 && report.non_manifold_vertex_count == 0;
  report.euler_characteristic =
      static_cast<long>(report.vertex_count) - static_cast<long>(report.edge_count) + static_cast<long>(report.triangle_count);
  if (report.closed && report.manifold && report.inconsistent_edge_count == 0)
    report.genus = static_cast<long>(report.component_count) - report.euler_characteristic / 2;
  measure(mesh, report);
  return report;
}

std::string to_text(const MeshReport& r) {
  std::string text = fmt::format("vertices              {}\ntriangles             {}\nedges                 {}\n", r.vertex_count,
                                 r.triangle_count, r.edge_count);
  text += fmt::format("components            {}\n", r.component_count);
  text += fmt::format("closed                {} ({} boundary edges)\n", yes_no(r.closed), r.boundary_edge_count);
  text += fmt::format("manifold              {} ({} edges and {} vertices are not)\n", yes_no(r.manifold),
                      r.non_manifold_edge_count, r.non_manifold_vertex_count);
  text += fmt::format("consistent winding    {} ({} edges are not)\n", yes_no(r.inconsistent_edge_count == 0),
                      r.inconsistent_edge_count);
  text += fmt::format("duplicate positions   {}\n", r.duplicate_position_count);
  text += fmt::format("zero-area triangles   {}\n", r.zero_area_triangle_count);
  text += fmt::format("Euler characteristic  {}\n", r.euler_characteristic);
  text += r.genus ? fmt::format("genus                 {}\n", *r.genus) : "";
  text += fmt::format("bounding box          {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}\n", r.lowest.x, r.lowest.y, r.lowest.z,
                      r.highest.x, r.highest.y, r.highest.z);
  text += fmt::format("area                  {:.6g}\n", r.area);
  text += r.volume ? fmt::format("enclosed volume       {:.6g}\n", *r.volume) : "";
  return text;
}

std::string to_json(const MeshReport& r) {
  const Json json = {
      {"vertices", r.vertex_count},
      {"triangles", r.triangle_count},
      {"edges", r.edge_count},
      {"components", r.component_count},
      {"closed", r.closed},
      {"manifold", r.manifold},
      {"boundary_edges", r.boundary_edge_count},
      {"non_manifold_edges", r.non_manifold_edge_count},
      {"non_manifold_vertices", r.non_manifold_vertex_count},
      {"inconsistent_edges", r.inconsistent_edge_count},
      {"duplicate_positions", r.duplicate_position_count},
      {"zero_area_triangles", r.zero_area_triangle_count},
      {"euler_characteristic", r.euler_characteristic},
      {"genus", r.genus},
      {"lowest", Json::array({r.lowest.x, r.lowest.y, r.lowest.z})},
      {"highest", Json::array({r.highest.x, r.highest.y, r.highest.z})},
      {"area", r.area},
      {"volume", r.volume},
  };
  return json.text(2) + "\n";
}

}  // namespace pliant
