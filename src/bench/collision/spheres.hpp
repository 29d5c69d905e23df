// The spheres that the suite `collision` searches.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>

#include "model/model.hpp"

namespace pliant::bench {

/// Returns a row of `icosphere:level`. `apart` leads from each one's centre to the next one's, in radii.
[[nodiscard]] ModelAndState spheres(std::size_t count, int level, const glm::dvec3& apart);
/// Returns two that overlap by 5 % of their diameter, but pressed flat where they face each other, half a gap apart.
[[nodiscard]] ModelAndState pressed_spheres(int level);

}  // namespace pliant::bench
