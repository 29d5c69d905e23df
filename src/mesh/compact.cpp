#include "mesh/compact.hpp"

namespace pliant {

std::size_t remove_unused_vertices(TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) used[vertex] = true;

  std::vector<std::uint32_t> new_index(mesh.positions.size());
  std::uint32_t kept_count = 0;
  for (std::size_t vertex = 0; vertex < used.size(); ++vertex) {
    if (!used[vertex]) continue;
    mesh.positions[kept_count] = mesh.positions[vertex];
    new_index[vertex] = kept_count++;
  }
  mesh.positions.resize(kept_count);
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& vertex : triangle) vertex = new_index[vertex];
  return used.size() - kept_count;
}

}  // namespace pliant
