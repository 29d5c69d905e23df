// Parts of bodies, and how kernels add up their sums: blocks of parts first (kernels/parts/rigid_motion_by_parts.glsl).
#include "state/vertex_parts.hpp"

#include <catch2/catch.hpp>
#include <functional>

namespace pliant {
namespace {

constexpr std::uint32_t vertex_counts[] = {1, 8, 9, 64, 65, 513, 1000, 4097};

// Bodies of so many vertices, and one between them that takes no part.
Model bodies_to_cut() {
  Model model;
  std::uint32_t first = 0;
  for (const std::uint32_t count : vertex_counts)
    for (const double damping : {1.0, 0.0}) {
      ModelBody& body = model.bodies.emplace_back();
      body.first_vertex = first;
      body.vertex_count = count;
      body.damping = damping;
      first += count;
    }
  return model;
}

TEST_CASE("parts cover each vertex of the bodies that take part, once and in order") {
  const Model model = bodies_to_cut();
  for (const auto& length_of : {std::function(cube_root_part), std::function([](std::uint32_t) { return 256u; })}) {
    const VertexParts all = vertex_parts(
        model, [](const ModelBody& body) { return body.damping > 0; }, length_of);
    REQUIRE(all.ranges.size() == model.bodies.size());
    std::uint32_t next_part = 0;
    for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
      const ModelBody& body = model.bodies[b];
      REQUIRE(all.ranges[b].x == next_part);
      REQUIRE((all.ranges[b].y > 0) == (body.damping > 0));
      std::uint32_t next_vertex = body.first_vertex;
      for (std::uint32_t k = 0; k < all.ranges[b].y; ++k) {
        const glm::uvec4 part = all.parts.at(next_part++);
        CHECK(part.x == b);
        CHECK(part.y == next_vertex);
        CHECK(part.z > part.y);
        next_vertex = part.z;
      }
      if (body.damping > 0) CHECK(next_vertex == body.first_vertex + body.vertex_count);
    }
    CHECK(next_part == all.count());
  }
}

TEST_CASE("a part has about as many vertices as a block has parts, and a body blocks") {
  const Model model = bodies_to_cut();
  const VertexParts all = vertex_parts(
      model, [](const ModelBody&) { return true; }, cube_root_part);
  for (const glm::uvec2& range : all.ranges) {
    const glm::uvec4 first = all.parts.at(range.x);
    const std::uint32_t vertices = model.bodies[first.x].vertex_count, block = first.w, blocks = (range.y + block - 1) / block;
    CAPTURE(vertices, block, blocks);
    CHECK(block <= blocks + 1);
    CHECK(blocks <= block + 1);
    CHECK(cube_root_part(vertices) >= std::min(vertices, 8u));
    if (vertices > 512) CHECK(cube_root_part(vertices) <= blocks + 1);
    for (std::uint32_t k = 0; k < range.y; ++k) CHECK(all.parts[range.x + k].w == block);
  }
}

}  // namespace
}  // namespace pliant
