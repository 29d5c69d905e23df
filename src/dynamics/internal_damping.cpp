// Before each stage one dispatch sums moments in parts. Another adds up each body's parts, and a third sets forces.
#include "dynamics/internal_damping.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

// About as many vertices as there are parts: one thread sums a part, and one thread adds up all parts of a body.
std::uint32_t part_length(std::uint32_t vertex_count) {
  return std::max<std::uint32_t>(8, static_cast<std::uint32_t>(std::sqrt(vertex_count)));
}

struct Parts {
  std::vector<glm::uvec4> parts;   // as moment_part
  std::vector<glm::uvec2> ranges;  // as moment_range, one for each body
};

void add_body(Parts& all, std::uint32_t index, const ModelBody& body) {
  const auto first_part = static_cast<std::uint32_t>(all.parts.size());
  const std::uint32_t end = body.first_vertex + body.vertex_count, length = part_length(body.vertex_count);
  if (body.damping > 0)
    for (std::uint32_t first = body.first_vertex; first < end; first += length)
      all.parts.emplace_back(index, first, std::min(first + length, end), 0);
  all.ranges.emplace_back(first_part, static_cast<std::uint32_t>(all.parts.size()) - first_part);
}

Parts parts_of(const Model& model) {
  Parts all;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) add_body(all, b, model.bodies[b]);
  return all;
}

}  // namespace

InternalDamping::InternalDamping(DeviceBodies& bodies, const Model& model, DampingLaw law) : bodies_(bodies) {
  if (law != DampingLaw::internal) return;
  const Parts all = parts_of(model);
  part_count_ = static_cast<std::uint32_t>(all.parts.size());
  if (!acts()) return;
  Arrays& arrays = bodies.arrays;
  arrays.make("moment_part", all.parts);
  arrays.make("moment_range", all.ranges);
  arrays.make<physics::Moments>("moment", all.parts.size());
  arrays.make<physics::RigidMotion>("rigid_motion", bodies.body_count);
  arrays.make<double>("added_force", std::size_t{3} * bodies.vertex_count);
  arrays.make<double>("acceleration", 1);  // a method with stages makes its own
}

std::vector<Pass> InternalDamping::passes(const StageState& at, bool is_first) const {
  if (!acts()) return {};
  const Parameters velocities = {{"slot", at.slot}, {"half_index", at.half}, {"stage_index", at.index}};
  return {make_pass(bodies_.arrays, "sum_moments", velocities, part_count_),
          make_pass(bodies_.arrays, "find_rigid_motion", velocities, bodies_.body_count),
          make_pass(bodies_.arrays, "spare_rigid_motion",
                    {{"slot", at.slot}, {"is_first", is_first ? 1u : 0u}, {"kick_time", at.kick_time}}, bodies_.vertex_count)};
}

}  // namespace pliant
