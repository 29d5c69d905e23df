// Cuts bodies into parts for sums over vertices in a fixed order.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "model/model.hpp"

namespace pliant {

struct VertexParts {
  std::vector<glm::uvec4> parts;   // body, first vertex, end of vertices, parts of a block
  std::vector<glm::uvec2> ranges;  // first part, number of parts, for each body

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(parts.size()); }
};

/// Returns how many vertices a part of a body of so many has, such that its parts can be summed one by one in about as many
/// steps, a block at a time, and then the blocks: the cube root.
[[nodiscard]] std::uint32_t cube_root_part(std::uint32_t vertex_count);

/// Cuts the bodies that `takes_part` into parts of the length that `length_of` returns for their number of vertices. A block has
/// about as many parts as its body has blocks.
[[nodiscard]] VertexParts vertex_parts(const Model& model, const std::function<bool(const ModelBody&)>& takes_part,
                                       const std::function<std::uint32_t(std::uint32_t)>& length_of);

}  // namespace pliant
