// Turns one body into a system of first order, y' = f(y), which is what other libraries integrate. Pliant's own vectors sum its
// springs in fp64 on one thread, so that forces cost every integrator the same.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "device/cpu/spring_sums.hpp"
#include "model/model.hpp"

namespace pliant::bench {

/// A state has three numbers a vertex for all displacements u [m], and then as many for all velocities over omega [m]. So
/// tolerances weigh both alike.
class PeerSystem {
 public:
  /// Expects one body, with springs alone and without gravity or internal damping, in a frame that is not turned. `model` must
  /// outlive the system.
  PeerSystem(const Model& model, DampingLaw law, double omega /* [rad/s] */);

  [[nodiscard]] std::vector<double> numbers_of(const State& state) const;
  /// Returns a state in the frame of `start`.
  [[nodiscard]] State state_of(const std::vector<double>& numbers, const State& start) const;
  [[nodiscard]] std::size_t size() const { return 6 * vertex_count_; }
  [[nodiscard]] double omega() const { return omega_; }
  [[nodiscard]] bool is_damped() const { return law_ != DampingLaw::none; }

  /// Computes f(y). Both arrays have size() numbers.
  void rates(const double* y, double* rates);
  /// Computes accelerations over the square of omega [m] at displacements u. Both arrays have size() / 2 numbers. Expects no
  /// damping.
  void accelerations(const double* u, double* scaled);
  /// Returns how often all forces were evaluated so far.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  void sum_springs(const double* u);
  [[nodiscard]] double damping_rate(const glm::dvec3& force) const;  // [1/s]

  const Model& model_;
  DampingLaw law_;
  double omega_;
  std::size_t vertex_count_;
  ThreadPool pool_{1};
  cpu::SpringSums<double> springs_;
  std::vector<glm::dvec4> rest_, positions_, displacements_;  // in the body's unit of length
  std::vector<glm::dvec3> sums_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace pliant::bench
