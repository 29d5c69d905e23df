// Two spheres about to collide: a small scene in which every kernel has work.
#pragma once
#include "support/evolve.hpp"

namespace pliant {

/// Bodies of 162 and 42 vertices that meet within a few steps of 0.01 s. The left one spins.
inline std::vector<BodySetup> colliding_spheres() {
  BodySetup left = sphere(2), right = sphere(1);
  left.description.name = "left";
  left.description.position = {-1.05, 0.1, 0};
  left.description.velocity = {2, 0, 0};
  left.description.spin = {0.5, 0, 1};
  left.description.stiffness = 10;
  right.description.name = "right";
  right.description.position = {1.05, -0.1, 0.05};
  right.description.velocity = {-2, 0, 0};
  right.description.stiffness = 20;
  return {left, right};
}

}  // namespace pliant
