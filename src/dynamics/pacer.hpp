// Records the dispatches that let a tolerance govern the steps: how long each is, and whether it stands.
#pragma once
#include <vector>

#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "physics/pace.glsl"

namespace pliant {

/// The error of a step is the largest of |dx| / r and |dv| / (r omega) over all vertices. dx and dv are the distances to the
/// embedded method's result. r is the body's radius. omega is its stiffest frequency or its largest damping rate, whichever is
/// higher.
///
/// A step that ends with bodies touching stands if the ways of all touching vertices, of whatever bodies, fit in a box. The box's
/// diagonal is a quarter of the shortest mean edge of any body. So no vertex has come deeper than that into another body. Motion
/// along the surfaces and pairs elsewhere widen the box, too.
struct PaceLimits {
  double tolerance = 0;     // of the error, above 0
  double first_step = 0;    // at the start, and the longest after a contact [s]
  double largest_step = 0;  // [s], may be infinite
  double end = 0;           // of the run [s]. A run that would need over 3e8 steps ends early
};

/// Returns how many steps to queue toward `target` [s], at most `most`. Steps beyond the target cost time for nothing, and so
/// does waiting for another report. If a motion is new, at the start or after a contact, steps are short. Then they are taken to
/// grow as fast as they may, up to the longest so far.
[[nodiscard]] std::uint64_t steps_toward(double target, const physics::Pace& pace, std::uint64_t most);

class Pacer {
 public:
  /// Expects a stepper with Stages::of_estimates, and a method that estimates its error. `bodies` must outlive the pacer. Without
  /// aim_at() every step is empty.
  Pacer(DeviceBodies& bodies, const Model& model, const Stepper& stepper, const Integrator& integrator, DampingLaw law,
        const PaceLimits& limits);
  Pacer(const Pacer&) = delete;
  Pacer& operator=(const Pacer&) = delete;

  /// Queues a change of where steps are to end [s]. No step goes beyond it. Steps that begin there are empty.
  void aim_at(double time);
  /// Waits for the queued steps.
  [[nodiscard]] physics::Pace pace() const;

  /// Fits the step to the target. It runs before the stepper's passes.
  [[nodiscard]] Pass beginning_pass() const;
  /// Estimates the error. It runs after the stepper's passes.
  [[nodiscard]] Pass estimating_pass() const;
  /// Extends the box of the ways of vertices with this step's mark. It runs after a search for contacts.
  [[nodiscard]] Pass contact_pass(std::uint32_t from_half) const;
  /// Judge the step, and undo one that does not stand. They run last.
  [[nodiscard]] std::vector<Pass> judging_passes(std::uint32_t from_half) const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t stage_count_;
};

}  // namespace pliant
