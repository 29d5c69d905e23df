// Runs steps that were recorded once, without reading back, and reports on them.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collision/collider.hpp"
#include "dynamics/grip.hpp"
#include "dynamics/pacer.hpp"
#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"
#include "simulation/step_passes.hpp"
#include "simulation/time_plan.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// The first vertex that went non-finite, or whose error ended a run with a tolerance.
struct NonFinite {
  std::uint64_t step = 0;              // the step that made it, from 1
  std::uint32_t body = 0, vertex = 0;  // vertex of the body
  double failed_step = 0;              // the step whose error ended the run [s]; else 0
  bool takes_too_many = false;         // at the length that errors have come to, more steps are left than a run may have

  bool operator==(const NonFinite&) const = default;
};

/// Of steps that a tolerance governs.
struct AdaptiveReport {
  std::uint64_t rejected = 0;                  // steps that were undone: their error was too large, or they met a contact
  std::uint64_t rejected_in_contact = 0;       // of them, those in which touching vertices moved too far against each other
  double smallest_step = 0, largest_step = 0;  // of the others [s]; 0: there are none
  double next_step = 0;                        // allowed, before it is fitted to a target [s]

  bool operator==(const AdaptiveReport&) const = default;
};

/// What the simulation did since its start.
struct StepReport {
  std::uint64_t steps = 0;  // completed, a non-finite one included; rejected ones are none
  double time = 0;          // of the state [s]
  std::optional<AdaptiveReport> adaptive;
  std::optional<NonFinite> non_finite;
  std::uint64_t contact_steps = 0;      // steps with a pair
  std::uint64_t contact_pairs_max = 0;  // most triangle pairs in one step
  std::uint64_t reverted_vertices = 0;
  std::uint64_t force_evaluations = 0;  // all forces of one body once
  std::uint64_t pair_interactions = 0;  // N (N - 1) for each of them
  std::uint64_t nodes_refitted = 0, node_tests = 0, triangle_tests = 0;
  std::uint64_t pairs_beyond_capacity = 0;  // pairs of leaves tested where they were found, the list being full
  std::uint64_t frame_changes = 0;          // of bodies' frames, following their rotation
  std::uint64_t forces_skipped = 0;         // force evaluations that were zero beforehand: a body moving rigidly
  std::uint64_t body_pairs_skipped = 0;     // root boxes apart
  std::uint64_t refits_skipped = 0;         // trees without a partner

  bool operator==(const StepReport&) const = default;
};

/// Triangles of different bodies that touch.
struct Intersections {
  std::uint64_t pairs = 0;
  std::vector<std::uint32_t> bodies;  // that take part
};

class Simulation {
 public:
  static constexpr std::uint64_t most_steps_at_once = 32;  // between reports, so that nobody waits long

  /// `device` and `model` must outlive the simulation.
  Simulation(Device& device, const Model& model, const State& start, const TimePlan& plan, const CollisionDescription& collision);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Queues steps of a fixed length; they may still be running when this returns. After a non-finite step nothing moves.
  void advance(std::uint64_t steps);
  /// With a tolerance instead: queues as many steps as may reach `time` [s], `most_steps` at most, waits, and reports. The
  /// last one ends there exactly; what is queued beyond it is empty. The same bits, however many are queued at a time.
  StepReport advance_toward(double time, std::uint64_t most_steps = most_steps_at_once);
  /// Goes on until report().time is `time` [s], or a step was non-finite.
  StepReport advance_to(double time);
  /// From here on the device waits after each pass, and notes what each kind of pass takes; or no more. Slower: see run_timed.
  void time_passes(bool timed = true) { timed_ = timed; }
  /// Device time since time_passes() by kernel [s].
  [[nodiscard]] const std::map<std::string_view, double>& pass_seconds() const { return pass_seconds_; }
  /// Between steps: queues a change of velocities, as drawing a body for so long does [s]. See Grip.
  void pull(const Pull& by, double seconds);
  /// Waits for the queued steps.
  [[nodiscard]] StepReport report();
  [[nodiscard]] State state();
  [[nodiscard]] std::vector<glm::vec4> world_positions();
  /// All that the next steps and reports depend on, as bytes. Waits for the queued steps.
  [[nodiscard]] std::string save();
  /// What save() gave of a simulation of the same bodies, plan and kind of collisions: goes on from there, bit for bit if on the
  /// same device. Throws Error (input), without a place, where the bytes do not fit; the simulation is then of no use.
  void restore(std::string_view saved);
  /// The vertices that touched another body when the latest queued step was looked at. Waits for it.
  [[nodiscard]] std::vector<std::uint32_t> touching_vertices();
  /// Tests the world positions as they stand, by the scene's own search and triangle test.
  [[nodiscard]] Intersections intersections();

  /// The device's own world positions: buffer and first element, for drawing.
  [[nodiscard]] BufferId position_buffer() const { return bodies_.world_positions.id(); }
  [[nodiscard]] std::uint32_t first_position() { return half() * bodies_.vertex_count; }
  /// Likewise its motions: doubles, 6 a vertex, from the same vertex on.
  [[nodiscard]] BufferId motion_buffer() const { return bodies_.motions.id(); }
  [[nodiscard]] const Collider& collider() const { return collider_; }

 private:
  [[nodiscard]] const physics::Control& control();  // after the queued steps, for which it waits
  [[nodiscard]] std::uint32_t half();               // the one that holds the current state
  [[nodiscard]] std::vector<Pass> schedule(std::uint32_t from_half) const;
  void queue(std::uint64_t steps);
  void add_pace(StepReport& report);

  Device& device_;
  const Model& model_;
  DeviceBodies bodies_;
  AddedForces added_forces_;
  Stepper stepper_;
  Collider collider_;
  std::optional<Grip> grip_;                       // of the latest pull
  std::optional<Pacer> pacer_;                     // where a tolerance governs the steps
  physics::Pace known_pace_{};                     // of the latest report
  double fixed_step_;                              // else their length [s]
  std::array<std::vector<Pass>, 2> schedules_;     // by the half that a step starts from
  std::optional<physics::Control> known_control_;  // read once for all who ask between steps
  std::uint64_t queued_steps_ = 0;                 // rejected and empty ones count here
  bool timed_ = false;
  std::map<std::string_view, double> pass_seconds_;
};

}  // namespace pliant
