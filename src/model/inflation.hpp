// Computes from a body's mesh what its pressure needs.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// Returns the inflation of `body`. Expects its rest positions and triangles to be the model's last. Throws Error (input) if the
/// mesh is open or not wound outward.
[[nodiscard]] Inflation inflate(const BodySetup& setup, const Model& model, const ModelBody& body);

}  // namespace pliant
