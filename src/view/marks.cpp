#include "view/marks.hpp"

#include "render/camera.hpp"

namespace pliant::view {
namespace {

using render::add_line;

constexpr glm::vec4 box_color(1.0f, 0.85f, 0.3f, 0.7f), velocity_color(0.35f, 0.9f, 0.55f, 0.8f);

void add_box(Lines& lines, const render::SceneBox& box) {
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned axis : {1u, 2u, 4u})
      if ((corner & axis) == 0) add_line(lines, corner_of(box, corner), corner_of(box, corner | axis), box_color);
}

render::SceneBox box_of(const Forest& forest, const TreeNode& node, std::span<const glm::dvec3> positions) {
  std::vector<glm::dvec3> corners;
  for (std::uint32_t t = node.first_triangle; t < node.end_of_triangles(); ++t)
    for (const std::uint32_t vertex : forest.triangles[t]) corners.push_back(positions[vertex]);
  return render::box_around(corners);
}

}  // namespace

void add_boxes(Lines& lines, const Forest& forest, std::span<const glm::dvec3> positions, unsigned level) {
  std::vector<unsigned> depth(forest.nodes.size(), 0);  // parents stand before their children
  for (std::size_t n = 0; n < forest.nodes.size(); ++n) {
    const TreeNode& node = forest.nodes[n];
    if (node.parent != no_node) depth[n] = depth[node.parent] + 1;
    if (depth[n] == level || (node.is_leaf() && depth[n] < level)) add_box(lines, box_of(forest, node, positions));
  }
}

void add_velocities(Lines& lines, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    add_line(lines, positions[i], positions[i] + 0.1 * velocities[i], velocity_color);
}

}  // namespace pliant::view
