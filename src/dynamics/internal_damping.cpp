// Before each stage one dispatch sums moments in parts. Another adds up each body's parts, and a third sets forces.
#include "dynamics/internal_damping.hpp"

#include "state/vertex_parts.hpp"

namespace pliant {

InternalDamping::InternalDamping(DeviceBodies& bodies, const Model& model, DampingLaw law) : bodies_(bodies) {
  if (law != DampingLaw::internal) return;
  const VertexParts all = vertex_parts(model, [](const ModelBody& body) { return body.damping > 0; });
  part_count_ = all.count();
  if (!acts()) return;
  Arrays& arrays = bodies.arrays;
  arrays.make("moment_part", all.parts);
  arrays.make("moment_range", all.ranges);
  arrays.make<physics::Moments>("moment", all.parts.size());
  arrays.make<physics::RigidMotion>("rigid_motion", bodies.body_count);
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
