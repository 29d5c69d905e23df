// The paper's response. A vertex that touches another body goes back to where the step began. Its velocity is reversed and scaled
// by the elasticity. A contact holds no more than a mark of the vertex.
#pragma once
#include "collision/responses/response.hpp"

namespace pliant {

[[nodiscard]] ResponseRow reflect_row();

}  // namespace pliant
