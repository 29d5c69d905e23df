// Another library's soft bodies over a floor, where the build found one: Bullet.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace pliant::bench {

class SoftPeer {
 public:
  virtual ~SoftPeer() = default;
  virtual void step(double time_step) = 0;
  /// Put positions [m] and velocities [m/s] of all vertices, in the order of the model's.
  virtual void read(std::span<glm::dvec3> positions, std::span<glm::dvec3> velocities) const = 0;
};

struct SoftLibrary {
  std::string name;  // with its version
  /// Makes bodies of the model's shapes and masses where `start` has them, at rest. The floor is y = 0, and gravity [m/s^2]
  /// points down.
  std::function<std::unique_ptr<SoftPeer>(const Model&, const State& start, double gravity)> build;
};

/// Is empty if the build did not find Bullet.
[[nodiscard]] std::vector<SoftLibrary> bullet_bodies();

}  // namespace pliant::bench
