// Measures energy and momentum of a state in fp64 on the host. Reports use it; stepping does not.
#pragma once
#include <any>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "core/thread_pool.hpp"
#include "model/model.hpp"

namespace pliant {

struct Measurement {
  double kinetic = 0;                // [J]
  double elastic = 0;                // [J], of all springs and other forces within bodies
  double elastic_size = 0;           // [J], the sum of the absolute energies of the forces
  double gravitational = 0;          // [J], zero at the world's origin
  glm::dvec3 momentum{0.0};          // [kg m/s]
  glm::dvec3 angular_momentum{0.0};  // [kg m^2/s], about the world's origin

  [[nodiscard]] double energy() const { return kinetic + elastic + gravitational; }
};

/// Measures states of one model, one after another.
class Meter {
 public:
  /// `model` must outlive the meter.
  explicit Meter(const Model& model);

  /// Visits every spring of bodies that have moved in their frames since the state before: N^2 / 2 for a body of N vertices. Of a
  /// clustered body it visits those that stand for them. The result has the same bits as that of another meter, on any number of
  /// threads. Several threads call `stopped` at once. When it returns true, the remaining springs are left out and the elastic
  /// energy is NaN. If `stopped` is null, nothing stops the measurement.
  [[nodiscard]] Measurement measure(const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                                    const std::function<bool()>& stopped = nullptr);

 private:
  // What each vertex adds to the sums. Vertices of static bodies add zero.
  struct Terms {
    std::vector<double> kinetic, gravitational;
    std::vector<glm::dvec3> momentum, angular_momentum;
  };

  void set_terms(const State& state, const glm::dvec3& gravity, ThreadPool& pool);

  const Model& model_;
  Terms terms_;
  std::vector<std::any> kept_;  // by forces, in the order of their list
};

/// Measures one state by a meter of its own.
[[nodiscard]] Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                                  const std::function<bool()>& stopped = nullptr);

}  // namespace pliant
