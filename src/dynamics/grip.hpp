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

/// Pulls change only velocities, and no faster than the body bears. So what is finite stays finite, whatever the targets are. A
/// body without springs can't be pulled.
class Grip {
 public:
  /// Grips the vertices around `vertex`, less and less with their distance at rest. `bodies` must outlive the grip, and knows one
  /// grip at a time.
  Grip(DeviceBodies& bodies, const Model& model, std::uint32_t vertex);
  Grip(const Grip&) = delete;
  Grip& operator=(const Grip&) = delete;

  [[nodiscard]] std::uint32_t vertex() const { return vertex_; }
  /// Queues a change of the place to which the next passes() draw the grip [m]. `seconds` is the time since the last ones [s].
  void aim_at(const glm::dvec3& target, double seconds);
  /// Returns the passes of one pull. They run between steps, with the state in `half`.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t half) const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t vertex_;
  double largest_acceleration_;  // of a vertex [m/s^2]
  double largest_change_;        // of a velocity by one pull [m/s]
  physics::Aim aim_{};
};

}  // namespace pliant
