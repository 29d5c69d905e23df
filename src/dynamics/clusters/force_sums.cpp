#include "dynamics/clusters/force_sums.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/clusters/cluster_pairs.hpp"

namespace pliant {
namespace {

constexpr double standard_tolerance = 1e-3;

// From so many vertices on clusters are faster (docs/benchmarks/2026-11-30-dense.md). A tenth of the tolerance takes about twice
// the time.
double fewest_vertices(DeviceKind device, double tolerance) {
  const double at_standard = device == DeviceKind::cpu ? 1500 : 5000;
  return at_standard * std::max(std::pow(standard_tolerance / tolerance, 0.3), 1.0);
}

}  // namespace

void choose_force_sums(Model& model, DeviceKind device) {
  for (ModelBody& body : model.bodies) {
    const bool suits = body.force_tolerance.has_value() && body.vertex_count >= fewest_vertices(device, force_tolerance_of(body));
    body.is_clustered = body.forces == ForceSum::clustered || (body.forces == ForceSum::automatic && suits);
  }
}

double force_tolerance_of(const ModelBody& body) { return body.force_tolerance.value_or(standard_tolerance); }

std::optional<ListBasis> list_basis_of(const ModelBody& body, const ChangedSums* changed) {
  if (!body.is_clustered || (changed != nullptr && changed->are_direct)) return {};
  if (changed != nullptr) return ListBasis{changed->accuracy, changed->displacements};
  return ListBasis{accuracy_of(force_tolerance_of(body)), {}};
}

}  // namespace pliant
