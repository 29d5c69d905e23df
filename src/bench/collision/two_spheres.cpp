#include "bench/collision/two_spheres.hpp"

#include <fmt/format.h>

#include <vector>

#include "mesh/generators.hpp"

namespace pliant::bench {

ModelAndState two_spheres(int level, const glm::dvec3& apart) {
  std::vector<BodySetup> setups(2);
  for (BodySetup& setup : setups) {
    setup.mesh = generate_mesh(fmt::format("icosphere:{}", level));
    setup.description.rotation = {10, 20, 30};  // no edge lies along an axis
  }
  setups[0].description.name = "first";
  setups[1].description.name = "second";
  setups[1].description.rotation = {40, 15, 70};
  setups[1].description.position = apart;
  return build_model(setups, glm::dvec3(0.0));
}

}  // namespace pliant::bench
