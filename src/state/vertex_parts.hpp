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
  std::vector<glm::uvec4> parts;   // body, first vertex, end of vertices, 0
  std::vector<glm::uvec2> ranges;  // first part, number of parts, for each body

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(parts.size()); }
};

/// Cuts the bodies that `takes_part`. A part has about as many vertices as its body has parts: one thread sums a part, and one
/// thread adds up all parts of a body.
[[nodiscard]] VertexParts vertex_parts(const Model& model, const std::function<bool(const ModelBody&)>& takes_part);

}  // namespace pliant
