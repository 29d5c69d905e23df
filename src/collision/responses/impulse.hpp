// Contact by impulses. Before a step, velocities are kicked so that no features come nearer than a gap. After it, each motion is
// proven to stay apart from its neighbours', or is cut short. docs/contact.md explains the method.
#pragma once
#include <memory>

#include "collision/responses/response.hpp"

namespace pliant {

[[nodiscard]] std::unique_ptr<Response> make_impulse(const ResponseSetting& setting);

}  // namespace pliant
