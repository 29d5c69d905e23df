// Before each stage one dispatch sums moments in parts. Another adds up each body's parts, and a third sets forces.
#include "dynamics/internal_damping.hpp"

#include "state/vertex_parts.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t part_of_a_group = 4 * physics::group_size;  // vertices

}  // namespace

InternalDamping::InternalDamping(DeviceBodies& bodies, const Model& model, DampingLaw law) : bodies_(bodies) {
  if (law != DampingLaw::internal) return;
  const VertexParts all = vertex_parts(
      model, [](const ModelBody& body) { return body.damping > 0; }, [](std::uint32_t) { return part_of_a_group; });
  part_count_ = all.count();
  if (!acts()) return;
  Arrays& arrays = bodies.arrays;
  arrays.make("moment_part", all.parts);
  arrays.make("moment_range", all.ranges);
  arrays.make<double>("moment", std::size_t{physics::moments_numbers} * all.parts.size());
  arrays.make<physics::RigidMotion>("rigid_motion", bodies.body_count);
}

std::vector<Pass> InternalDamping::passes(const StageState& at, bool is_first) const {
  if (!acts()) return {};
  const Parameters velocities = {{"slot", at.slot}, {"half_index", at.half}, {"stage_index", at.index}};
  const auto group_pass = [&](std::string_view name, std::uint32_t items) {
    const KernelId kernel = bodies_.arrays.device().group_kernel(name, physics::group_size);
    return make_pass(bodies_.arrays, name, kernel, velocities, items);
  };
  return {group_pass("sum_moments", part_count_), group_pass("find_rigid_motion", bodies_.body_count),
          make_pass(bodies_.arrays, "spare_rigid_motion",
                    {{"slot", at.slot}, {"is_first", is_first ? 1u : 0u}, {"kick_time", at.kick_time}}, bodies_.vertex_count)};
}

}  // namespace pliant
