#include "state/vertex_parts.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

std::uint32_t rounded_up(double number) { return static_cast<std::uint32_t>(std::ceil(number)); }

void add_parts(VertexParts& all, std::uint32_t index, const ModelBody& body, std::uint32_t length) {
  const std::uint32_t end = body.first_vertex + body.vertex_count, count = (body.vertex_count + length - 1) / length;
  const std::uint32_t block = rounded_up(std::sqrt(count));
  for (std::uint32_t first = body.first_vertex; first < end; first += length)
    all.parts.emplace_back(index, first, std::min(first + length, end), block);
}

}  // namespace

std::uint32_t cube_root_part(std::uint32_t vertex_count) { return std::max(8u, rounded_up(std::cbrt(vertex_count))); }

VertexParts vertex_parts(const Model& model, const std::function<bool(const ModelBody&)>& takes_part,
                         const std::function<std::uint32_t(std::uint32_t)>& length_of) {
  VertexParts all;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    const std::uint32_t first_part = all.count();
    if (takes_part(model.bodies[b])) add_parts(all, b, model.bodies[b], length_of(model.bodies[b].vertex_count));
    all.ranges.emplace_back(first_part, all.count() - first_part);
  }
  return all;
}

}  // namespace pliant
