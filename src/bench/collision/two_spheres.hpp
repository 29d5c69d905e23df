// The two spheres that the suite `collision` searches.
#pragma once
#include <glm/vec3.hpp>

#include "model/model.hpp"

namespace pliant::bench {

/// Returns two of `icosphere:level`. `apart` leads from the first one's centre to the second one's, in radii.
[[nodiscard]] ModelAndState two_spheres(int level, const glm::dvec3& apart);
/// Returns those that overlap by 5 % of their diameter, but pressed flat where they face each other, half a gap apart.
[[nodiscard]] ModelAndState pressed_spheres(int level);

}  // namespace pliant::bench
