// The simulated bodies on a device: what dynamics and collision both work on.
#pragma once
#include <glm/vec4.hpp>
#include <span>

#include "device/device.hpp"
#include "model/model.hpp"
#include "physics/body.glsl"
#include "physics/control.glsl"
#include "state/carried_array.hpp"

namespace pliant {

/// Motions and world positions have two halves of vertex_count vertices. A step reads one half and writes the other.
struct DeviceBodies {
  /// Cut into shares for the device's best force variant, or for the given one.
  DeviceBodies(Device& device, const Model& model, const State& state);
  DeviceBodies(Device& device, const Model& model, const State& state, std::size_t force_variant);

  std::uint32_t vertex_count = 0, body_count = 0;
  std::size_t force_variant;
  bool all_stages_at_once = false;  // whether force kernels run all stages of a step in one dispatch
  DeviceArray<physics::Body> bodies;
  DeviceArray<physics::Share> shares;  // of all bodies, what one item of a force kernel serves
  DeviceArray<physics::Frame> frames;
  DeviceArray<glm::vec4> rest_positions;   // w: body index
  DeviceArray<double> motions;             // [half][vertex][6]: u [m], w [m/s]
  DeviceArray<glm::vec4> world_positions;  // [half][vertex], written once a step [m]
  DeviceArray<std::uint32_t> placements;   // real4 [slot][2][vertex]: position, displacement in units of the body's length; then
                                           // [2][vertex]: what rounding the placements of a step's stages has done so far
  DeviceArray<physics::Control> control;   // one

  /// The state in a half, from which another run may start: no body is halted for now.
  [[nodiscard]] State download(std::uint32_t half) const;
  /// Between steps.
  [[nodiscard]] std::vector<CarriedArray> carried_arrays() const;
  /// Makes bodies ready to be bounded and searched outside of a step: their boxes empty, as follow_bodies leaves them,
  /// and none halted for now.
  void prepare_search();
  /// Of all bodies' steps from here on [s].
  void set_time_step(double time_step);
  /// Where each body's own tableau begins.
  void set_tableau_rows(std::span<const std::uint32_t> rows);
};

}  // namespace pliant
