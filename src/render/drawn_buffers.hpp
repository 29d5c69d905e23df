// Where a renderer finds what a simulation holds: in the buffers of a GPU device, or in copies of what a CPU device has.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "device/device.hpp"
#include "gl/objects.hpp"
#include "simulation/simulation.hpp"

namespace pliant::render {

struct DrawnBuffer {
  std::uint32_t id = 0;            // of OpenGL
  std::uint32_t first_vertex = 0;  // the element that is the model's vertex 0
};

/// Needs a current gl::Context while it lives, which is that of any GPU device it is asked of. What it gives stands until the
/// next step. Throws Error (device) where there is no room for a copy.
class DrawnBuffers {
 public:
  /// World positions: a vec4 a vertex [m].
  [[nodiscard]] DrawnBuffer positions(Device& device, Simulation& simulation);
  /// Motions: 6 doubles a vertex [m], [m/s].
  [[nodiscard]] DrawnBuffer motions(Device& device, Simulation& simulation);

 private:
  gl::Buffer positions_, motions_;  // copies
};

}  // namespace pliant::render
