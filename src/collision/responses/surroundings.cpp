#include "collision/responses/surroundings.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace pliant {
namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;

// An edge of a triangle, from a corner to the next.
struct Side {
  std::pair<std::uint32_t, std::uint32_t> edge;  // its vertices in their order
  std::size_t place;                             // 3 * triangle + corner
};

// Those of one edge stand together, in the order of their triangles.
std::vector<Side> sorted_sides(Triangles triangles) {
  std::vector<Side> sides;
  for (std::size_t place = 0; place < 3 * triangles.size(); ++place) {
    const std::array<std::uint32_t, 3>& corners = triangles[place / 3];
    sides.push_back({std::minmax(corners[place % 3], corners[(place + 1) % 3]), place});
  }
  std::ranges::sort(sides, {}, [](const Side& side) { return std::pair(side.edge, side.place); });
  return sides;
}

std::uint32_t& owned_by(std::vector<std::uint32_t>& around, std::size_t triangle) { return around[4 * triangle + 3]; }

void give_vertices(std::vector<std::uint32_t>& around, Triangles triangles, std::uint32_t first_vertex,
                   std::uint32_t vertex_count) {
  std::vector<bool> is_owned(vertex_count);
  for (std::size_t place = 0; place < 3 * triangles.size(); ++place) {
    const std::uint32_t vertex = triangles[place / 3][place % 3] - first_vertex;
    if (!is_owned[vertex]) owned_by(around, place / 3) |= 1u << place % 3;
    is_owned[vertex] = true;
  }
}

// Gives edges to triangles, and says what lies across them.
void give_edges(std::vector<std::uint32_t>& around, Triangles triangles, std::uint32_t first_vertex) {
  const auto across = [&](const Side& side) -> std::uint32_t& { return around[4 * (side.place / 3) + side.place % 3]; };
  const auto third = [&](const Side& side) { return triangles[side.place / 3][(side.place + 2) % 3] - first_vertex; };
  const std::vector<Side> sides = sorted_sides(triangles);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto end = std::find_if(first, sides.end(), [&](const Side& side) { return side.edge != first->edge; });
    owned_by(around, first->place / 3) |= 8u << first->place % 3;
    if (end - first == 2) {
      across(first[0]) = third(first[1]);
      across(first[1]) = third(first[0]);
    }
    first = end;
  }
}

}  // namespace

std::vector<std::uint32_t> surroundings(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t first_vertex,
                                        std::uint32_t vertex_count) {
  std::vector<std::uint32_t> around(4 * triangles.size(), physics::no_vertex);
  for (std::size_t t = 0; t < triangles.size(); ++t) owned_by(around, t) = 0;
  give_vertices(around, triangles, first_vertex, vertex_count);
  give_edges(around, triangles, first_vertex);
  return around;
}

std::vector<std::uint32_t> surroundings_of(const Model& model, const Forest& forest, std::span<physics::Surface> surfaces) {
  std::vector<std::uint32_t> all;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;  // and where each begins, in triangles
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const ModelBody& body = model.bodies[b];
    const Triangles triangles = Triangles(forest.triangles).subspan(body.first_triangle, body.triangle_count);
    const auto [place, is_new] = known.try_emplace(surroundings(triangles, body.first_vertex, body.vertex_count),
                                                   static_cast<std::uint32_t>(all.size() / 4));
    if (is_new) all.insert(all.end(), place->first.begin(), place->first.end());
    surfaces[b].to_mesh = place->second - body.first_triangle;
  }
  return all;
}

}  // namespace pliant
