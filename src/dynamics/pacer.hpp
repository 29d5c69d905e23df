// Records the dispatches that let a tolerance govern the steps: how long each is, and whether it stands.
#pragma once
#include <vector>

#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "physics/pace.glsl"

namespace pliant {

/// The error of a step is the largest over all vertices of |dx| / r and |dv| / (r omega): dx and dv are the distances to the
/// embedded method's result, r the body's radius, omega its stiffest frequency or, if that is higher, its largest damping rate.
///
/// A step that ends with bodies touching stands if the ways of all touching vertices, of whatever bodies, fit in a box whose
/// diagonal is a quarter of an edge: the shortest mean edge of any body. So none has come deeper into another body; but
/// motion along the surfaces and pairs elsewhere widen the box, too.
struct PaceLimits {
  double tolerance = 0;     // of the error; above 0
  double first_step = 0;    // at the start, and the longest after a contact [s]
  double largest_step = 0;  // [s]; may be infinite
  double end = 0;           // of the run [s]: one that would take over 3e8 steps to it ends
};

/// How many steps to queue toward `target` [s], `most` at most: what is beyond it costs time for nothing, and so does waiting for
/// another report. Where steps are short because a motion is new, at the start or after a contact, they are taken to grow as
/// fast as they may, up to the longest so far.
[[nodiscard]] std::uint64_t steps_toward(double target, const physics::Pace& pace, std::uint64_t most);

class Pacer {
 public:
  /// Expects a stepper with Stages::of_estimates, of a method that estimates_error. `bodies` must outlive the pacer.
  /// Without aim_at() every step is empty.
  Pacer(DeviceBodies& bodies, const Model& model, const Stepper& stepper, const Integrator& integrator, DampingLaw law,
        const PaceLimits& limits);
  Pacer(const Pacer&) = delete;
  Pacer& operator=(const Pacer&) = delete;

  /// Queues a change of where steps are to end [s]. Before it, steps are empty; none goes beyond it.
  void aim_at(double time);
  /// Waits for the queued steps.
  [[nodiscard]] physics::Pace pace() const;

  /// Before the stepper's passes: fits the step to the target.
  [[nodiscard]] Pass beginning_pass() const;
  /// After them: estimates the error.
  [[nodiscard]] Pass estimating_pass() const;
  /// After a search for contacts: extends the box of the ways of vertices with this step's mark.
  [[nodiscard]] Pass contact_pass(std::uint32_t from_half) const;
  /// At last: judges, and undoes a step that does not stand.
  [[nodiscard]] std::vector<Pass> judging_passes(std::uint32_t from_half) const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t stage_count_;
};

}  // namespace pliant
