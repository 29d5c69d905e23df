// Sorts triangle corners by vertex with a counting sort.
#include "mesh/incident_triangles.hpp"

#include <numeric>

namespace pliant {

IncidentTriangles incident_triangles(std::uint32_t vertex_count, std::span<const std::array<std::uint32_t, 3>> triangles) {
  IncidentTriangles incident;
  incident.first.assign(vertex_count + std::size_t{1}, 0);
  incident.others.resize(triangles.size() * 3);
  for (const auto& triangle : triangles) {
    for (std::uint32_t vertex : triangle) ++incident.first[vertex + std::size_t{1}];
  }
  std::partial_sum(incident.first.begin(), incident.first.end(), incident.first.begin());
  std::vector<std::uint32_t> next(incident.first.begin(), incident.first.end() - 1);
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) incident.others[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  return incident;
}

}  // namespace pliant
