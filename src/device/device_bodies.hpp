// The simulated bodies on a device: what dynamics and collision both work on.
#pragma once
#include <glm/vec4.hpp>

#include "device/device.hpp"
#include "model/model.hpp"
#include "physics/body.glsl"
#include "physics/control.glsl"

namespace pliant {

/// Motions and world positions have two halves of vertex_count vertices. A step reads one half and writes the other.
struct DeviceBodies {
  DeviceBodies(Device& device, const Model& model, const State& state);

  std::uint32_t vertex_count = 0, body_count = 0;
  DeviceArray<physics::Body> bodies;
  DeviceArray<physics::Frame> frames;
  DeviceArray<glm::vec4> rest_positions;   // w: body index
  DeviceArray<double> motions;             // [half][vertex][6]: u [m], w [m/s]
  DeviceArray<glm::vec4> world_positions;  // [half][vertex], written once a step [m]
  DeviceArray<std::uint32_t> body_boxes;   // [body][6]: lower, upper, as ordered bits
  DeviceArray<physics::Control> control;   // one

  [[nodiscard]] State download(std::uint32_t half) const;
  /// Makes every body's box empty, as the first pass of a step does.
  void clear_boxes();
};

}  // namespace pliant
