// Which bodies' springs are summed by clusters, and how exactly.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "device/device.hpp"
#include "model/model.hpp"

namespace pliant {

/// Settles which bodies are clustered where that is left to pliant: those that have a tolerance for forces, and so many vertices
/// that clusters are faster on this kind of device.
void choose_force_sums(Model& model, DeviceKind device);

/// Returns the relative error that a clustered body's forces may have.
[[nodiscard]] double force_tolerance_of(const ModelBody& body);

/// What the lists of a clustered body are made for, as pair_clusters() has it.
struct ListBasis {
  double accuracy = 0;
  std::span<const glm::dvec3> displacements = {};  // of a shape beside the rest shape [m]; empty: there is none
};

/// Returns the basis of a body's lists, or nothing if its springs are summed one by one. `changed` is null if its sums have not
/// changed, and has to outlive the basis.
[[nodiscard]] std::optional<ListBasis> list_basis_of(const ModelBody& body, const ChangedSums* changed);

}  // namespace pliant
