// The pressure inside a body, from its mesh.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// Of `body`, whose rest positions and triangles are the last of the model's. Throws Error (input) where the mesh is open or not
/// wound outward.
[[nodiscard]] Inflation inflate(const BodySetup& setup, const Model& model, const ModelBody& body);

}  // namespace pliant
