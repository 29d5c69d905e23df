// What contact costs a step.
#pragma once
#include "bench/contact/contact.hpp"
#include "device/device.hpp"

namespace pliant::bench {

/// Lets two spheres meet by `verlet`, icosphere:level each. They come nearer by so many mean edges a step.
[[nodiscard]] CostRow measure_cost(Device& device, int level, double edges_a_step);

}  // namespace pliant::bench
