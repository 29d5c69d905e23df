// The paper's response. A vertex that touches another body goes back to where the step began. Its velocity is reversed and scaled
// by the elasticity. A contact holds no more than a mark of the vertex.
#pragma once
#include <memory>

#include "collision/responses/response.hpp"

namespace pliant {

[[nodiscard]] std::unique_ptr<Response> make_reflect(const ResponseSetting& setting);

}  // namespace pliant
