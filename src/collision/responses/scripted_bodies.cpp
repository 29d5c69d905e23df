#include "collision/responses/scripted_bodies.hpp"

#include <algorithm>
#include <iterator>

namespace pliant {

ScriptedBodies::ScriptedBodies(DeviceBodies& bodies, const Model& model) : bodies_(bodies) {
  std::vector<physics::Path> paths;
  std::vector<physics::PathKey> keys;
  for (const ModelBody& body : model.bodies) {
    physics::Path& way = paths.emplace_back();
    if (!body.path) continue;
    scripted_.push_back(static_cast<std::uint32_t>(paths.size() - 1));
    way = body.path->way;
    way.first_key = static_cast<std::uint32_t>(keys.size());
    std::ranges::copy(body.path->keys, std::back_inserter(keys));
  }
  if (scripted_.empty()) return;
  physics::PathState at_start{};
  at_start.pace = 1;
  bodies.arrays.make("path", paths);
  bodies.arrays.make("path_key", keys);
  bodies.arrays.make("path_state", std::vector(paths.size(), at_start));
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
  const std::vector<physics::PathState> states = bodies_.arrays.get<physics::PathState>("path_state").download();
  std::vector<ScriptReport> reports;
  for (const std::uint32_t b : scripted_)
    reports.push_back({.body = b, .time = states[b].time, .waited = states[b].waited, .waits = states[b].waits});
  return reports;
}

}  // namespace pliant
