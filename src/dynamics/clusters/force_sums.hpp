// Which bodies' springs are summed by clusters, and how exactly.
#pragma once
#include "device/device.hpp"
#include "model/model.hpp"

namespace pliant {

/// Settles which bodies are clustered where that is left to pliant: those that have a tolerance for forces, and so many vertices
/// that clusters are faster on this kind of device.
void choose_force_sums(Model& model, DeviceKind device);

/// Returns the relative error that a clustered body's forces may have.
[[nodiscard]] double force_tolerance_of(const ModelBody& body);

}  // namespace pliant
