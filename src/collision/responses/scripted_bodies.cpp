#include "collision/responses/scripted_bodies.hpp"

namespace pliant {

ScriptedBodies::ScriptedBodies(const DeviceBodies& bodies, const Model& model) : bodies_(bodies) {
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].path) scripted_.push_back(b);
}

std::vector<Pass> ScriptedBodies::bounding_passes() const {
  if (scripted_.empty()) return {};
  return {make_pass(bodies_.arrays, "bound_paths", {}, bodies_.body_count)};
}

std::vector<Pass> ScriptedBodies::following_passes() const {
  if (scripted_.empty()) return {};
  return {make_pass(bodies_.arrays, "follow_paths", {}, bodies_.body_count)};
}

std::vector<Pass> ScriptedBodies::moving_passes(std::uint32_t from_half) const {
  if (scripted_.empty()) return {};
  return {make_pass(bodies_.arrays, "move_along_paths", {{"from_half", from_half}}, bodies_.vertex_count)};
}

std::vector<Pass> ScriptedBodies::ending_passes(const Parameters& capacities) const {
  if (scripted_.empty()) return {};
  return {make_pass(bodies_.arrays, "end_paths", capacities, bodies_.body_count)};
}

std::vector<ScriptReport> ScriptedBodies::report() const {
  if (scripted_.empty()) return {};
  const std::vector<physics::PathState> states = bodies_.path_states->download();
  std::vector<ScriptReport> reports;
  for (const std::uint32_t b : scripted_)
    reports.push_back({.body = b, .time = states[b].time, .waited = states[b].waited, .waits = states[b].waits});
  return reports;
}

}  // namespace pliant
