// What self-contact costs a step of a body that does not touch itself.
#pragma once
#include <string>

#include "bench/contact/contact.hpp"
#include "device/device.hpp"

namespace pliant::bench {

/// Moves one body of a mesh by `cv8`, with self-contact and without, in turns. It flies and vibrates, or rests on a ground.
[[nodiscard]] SelfCostRow measure_self_cost(Device& device, const std::string& mesh, bool rests);

}  // namespace pliant::bench
