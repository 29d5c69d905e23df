#include "state/vertex_parts.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

std::uint32_t part_length(std::uint32_t vertex_count) {
  return std::max<std::uint32_t>(8, static_cast<std::uint32_t>(std::sqrt(vertex_count)));
}

void add_parts(VertexParts& all, std::uint32_t index, const ModelBody& body) {
  const std::uint32_t end = body.first_vertex + body.vertex_count, length = part_length(body.vertex_count);
  for (std::uint32_t first = body.first_vertex; first < end; first += length)
    all.parts.emplace_back(index, first, std::min(first + length, end), 0);
}

}  // namespace

VertexParts vertex_parts(const Model& model, const std::function<bool(const ModelBody&)>& takes_part) {
  VertexParts all;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    const std::uint32_t first_part = all.count();
    if (takes_part(model.bodies[b])) add_parts(all, b, model.bodies[b]);
    all.ranges.emplace_back(first_part, all.count() - first_part);
  }
  return all;
}

}  // namespace pliant
