#include "dynamics/clusters/force_sums.hpp"

namespace pliant {
namespace {

constexpr double standard_tolerance = 1e-3;

// From so many vertices on clusters are faster, at the standard tolerance (docs/benchmarks/2026-11-29-dense.md).
constexpr std::uint32_t fewest_vertices(DeviceKind device) { return device == DeviceKind::cpu ? 1500 : 5000; }

}  // namespace

void choose_force_sums(Model& model, DeviceKind device) {
  for (ModelBody& body : model.bodies)
    body.is_clustered =
        body.forces == ForceSum::clustered ||
        (body.forces == ForceSum::automatic && body.force_tolerance.has_value() && body.vertex_count >= fewest_vertices(device));
}

double force_tolerance_of(const ModelBody& body) { return body.force_tolerance.value_or(standard_tolerance); }

}  // namespace pliant
