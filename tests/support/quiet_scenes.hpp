// Bodies of which few come near each other, so that most steps are quiet.
#pragma once
#include <vector>

#include "support/impulse_scene.hpp"

namespace pliant {

inline BodySetup ball_of(const char* mesh, const glm::dvec3& place) {
  BodySetup setup = soft(generate_mesh(mesh), "ball");
  setup.description.position = place;
  return setup;
}

// One turns and vibrates, one comes towards it undeformed, one rests and one turns aside.
inline std::vector<BodySetup> four_balls() {
  std::vector<BodySetup> setups = {ball_of("icosphere:1", {0, 0, 0}), ball_of("icosphere:0", {12, 0.3, 0}),
                                   ball_of("icosphere:1", {0, 9, 0}), ball_of("cube:1", {0, 0, -9})};
  setups[0].description.stretch = {1.1, 0.95, 1};
  setups[0].description.spin = {0, 2, 1};
  setups[1].description.velocity = {-6, 0, 0};
  setups[3].description.velocity = {0.1, 0, -0.2};
  setups[3].description.spin = {0.5, 0, 0};
  return setups;
}

}  // namespace pliant
