// Bodies that come to rest: on a ground, on static meshes, and on each other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "model/model.hpp"

namespace pliant::bench {

/// Bodies with gravity and damping, just above what they will rest on. Those that move come last, and are alike.
struct RestingPlace {
  std::string name;
  ModelAndState start;
};

/// Returns a ball on a ground, on a slab of triangles, in a bowl, and wedged between four spheres, a ball of 5 cm on a slab with
/// edges of 10 m, and a stack of three cubes.
[[nodiscard]] std::vector<RestingPlace> resting_places();

/// How many steps bodies get to settle, and for how many more they are watched.
struct RestWatch {
  std::uint64_t settling = 4000, watched = 10000;
  std::stop_token stop = {};  // ends the watch early
};

/// What was seen of bodies at rest. Lengths count in mean edges of the last body's mesh.
struct RestSeen {
  double most_a_step = 0;  // the longest way of a vertex in a step
  double drift = 0;        // the farthest that a vertex came from where it was at first
  double edge = 0;         // [m]
  std::uint64_t cut_vertices = 0;
  std::uint64_t contacts = 0;  // in the last step
  std::size_t inside = 0;      // vertices inside another body at the end
};

/// Runs by verlet, with steps of 0.3 / omega, elasticity 0 and friction 0.5.
[[nodiscard]] RestSeen watch_rest(Device& device, const RestingPlace& place, const RestWatch& how);

}  // namespace pliant::bench
