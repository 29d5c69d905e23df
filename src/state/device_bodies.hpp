// The simulated bodies on a device. Dynamics and collision both work on them.
#pragma once
#include <glm/vec4.hpp>
#include <span>

#include "device/device.hpp"
#include "model/model.hpp"
#include "physics/body.glsl"
#include "physics/control.glsl"
#include "physics/layout.glsl"
#include "state/arrays.hpp"
#include "state/force_groups.hpp"

namespace pliant {

/// Motions and world positions have two halves of vertex_count vertices. A step reads one half and writes the other.
struct DeviceBodies {
  /// Cuts bodies into shares for the device's best force variants, for the given one (but for clustered bodies), or for one for
  /// each body.
  DeviceBodies(Device& device, const Model& model, const State& state);
  DeviceBodies(Device& device, const Model& model, const State& state, std::size_t force_variant);
  DeviceBodies(Device& device, const Model& model, const State& state, const std::vector<std::size_t>& force_variants);

  DeviceBodies(const DeviceBodies&) = delete;
  DeviceBodies& operator=(const DeviceBodies&) = delete;

  std::uint32_t vertex_count = 0, body_count = 0;
  std::vector<std::size_t> force_variants;  // of each body, as one device alone would sum its springs
  std::vector<ForceGroup> force_groups;
  Arrays arrays;  // these, and those that others make for the same simulation
  DeviceArray<physics::Pose>& poses;
  DeviceArray<physics::Status>& statuses;
  DeviceArray<physics::Tally>& tallies;
  DeviceArray<double>& motions;
  DeviceArray<glm::vec4>& world_positions;
  DeviceArray<physics::Control>& control;
  DeviceArray<physics::PathState>* path_states = nullptr;  // null without scripted bodies

  [[nodiscard]] DeviceArray<physics::Share>& shares() const { return arrays.get<physics::Share>("share"); }
  /// Returns the place of a half's first vertex in motions and in world positions.
  [[nodiscard]] std::uint32_t first_of_half(std::uint32_t half) const { return physics::in_half(half, vertex_count, 0); }
  /// Returns the state in a half, from which another run may start.
  [[nodiscard]] State download(std::uint32_t half) const;
  /// Puts it into a state whose memory is used again.
  void download(std::uint32_t half, State& into) const;
  /// Makes bodies ready to be bounded and searched outside of a step. It empties their boxes, and counts no body as
  /// halted for now, at rest, or asleep.
  void prepare_search();
  /// Has steps go on from carried arrays alone. Boxes that earlier steps kept of bodies at rest stand elsewhere.
  void begin_anew();
  /// Has the next step look at bodies at rest, too, because what an earlier one found of them is lost.
  void look_at_bodies_at_rest();
  /// Sets the length of all steps from here on [s].
  void set_time_step(double time_step);
  /// Sets where each body's own tableau begins.
  void set_tableau_rows(std::span<const std::uint32_t> rows);
  /// Cuts bodies into shares anew. Other passes sum the springs of those bodies whose sums are given. Passes that were recorded
  /// before do not hold any more.
  void cut_into_shares(const Model& model, const std::vector<bool>& are_given);
  /// Does so for the sums of all bodies, while `force_variants` stay as they are.
  void have_all_sums_given(const Model& model);
  /// Has every stage be a dispatch of its own, or all stages one, if the variants can.
  void run_all_stages(bool at_once);
  /// Gives scripted bodies their paths, from these times on.
  void make_paths(const Model& model, const State& start);
  /// Makes room for placements, as many slots as the method needs.
  void make_placements(std::uint32_t slots);

 private:
  void cut_into_shares(const Model& model, const std::vector<bool>& are_given, const std::vector<std::size_t>& variants);

  std::vector<std::uint32_t> tableau_rows_;  // of bodies; empty: all are 0
};

}  // namespace pliant
