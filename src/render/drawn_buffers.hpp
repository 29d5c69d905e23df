// Gives a renderer the arrays of a simulation as GL buffers. A GPU device has them already. From a CPU device they are copied.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "device/device.hpp"
#include "gl/objects.hpp"
#include "simulation/simulation.hpp"

namespace pliant::render {

struct DrawnBuffer {
  std::uint32_t id = 0;            // name of the GL buffer
  std::uint32_t first_vertex = 0;  // index of the element that belongs to the model's vertex 0
};

/// Needs a current gl::Context while it lives. A GPU device must use the same context. A returned buffer is valid until the next
/// step. Throws Error (device) if there is no room for a copy.
class DrawnBuffers {
 public:
  /// Returns the world positions, one vec4 a vertex [m].
  [[nodiscard]] DrawnBuffer positions(Device& device, Simulation& simulation);
  /// Returns the motions, 6 doubles a vertex: displacement [m] and velocity [m/s] in the body's frame.
  [[nodiscard]] DrawnBuffer motions(Device& device, Simulation& simulation);

 private:
  gl::Buffer positions_, motions_;  // copies
};

}  // namespace pliant::render
