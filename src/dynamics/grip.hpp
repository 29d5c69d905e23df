// Holds a body at a part of its surface, and pulls it there between steps, as a mouse does.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "device/pass.hpp"
#include "physics/pull.glsl"
#include "state/device_bodies.hpp"

namespace pliant {

/// A place in the world that a body is drawn to by one of its vertices.
struct Pull {
  std::uint32_t vertex = 0;  // of the model
  glm::dvec3 target{0.0};    // [m]
};

/// Pulls change velocities alone, and no faster than the body bears: whatever the targets are, what is finite stays so. A body
/// without springs can't be pulled.
class Grip {
 public:
  /// Of the vertices around one, less and less with their distance at rest. `bodies` must outlive the grip, and knows one
  /// at a time.
  Grip(DeviceBodies& bodies, const Model& model, std::uint32_t vertex);
  Grip(const Grip&) = delete;
  Grip& operator=(const Grip&) = delete;

  [[nodiscard]] std::uint32_t vertex() const { return vertex_; }
  /// Queues where the next passes() draw the grip [m], for a time that has gone by since the last ones [s].
  void aim_at(const glm::dvec3& target, double seconds);
  /// Between steps, with the state in `half`.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t half) const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t vertex_;
  double largest_acceleration_;  // of a vertex [m/s^2]
  double largest_change_;        // of a velocity by one pull [m/s]
  physics::Aim aim_{};
};

}  // namespace pliant
