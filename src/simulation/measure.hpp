// Energy and momentum of a state, in fp64 on the host: for reports, not for stepping.
#pragma once
#include <functional>
#include <glm/vec3.hpp>

#include "core/thread_pool.hpp"
#include "model/model.hpp"

namespace pliant {

struct Measurement {
  double kinetic = 0;                // [J]
  double elastic = 0;                // [J], of all springs and other forces within bodies
  double elastic_size = 0;           // [J], each force's counting as positive
  double gravitational = 0;          // [J], zero at the world's origin
  glm::dvec3 momentum{0.0};          // [kg m/s]
  glm::dvec3 angular_momentum{0.0};  // [kg m^2/s], about the world's origin

  [[nodiscard]] double energy() const { return kinetic + elastic + gravitational; }
};

/// Visits every spring: N^2 / 2 of a body of N vertices. The same bits on any number of threads. Once `stopped` answers true
/// (several threads ask at once), springs are left out and the elastic energy is NaN; null: nobody stops it.
[[nodiscard]] Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                                  const std::function<bool()>& stopped = nullptr);

}  // namespace pliant
