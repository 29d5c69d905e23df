// Runs steps and reports on them. The passes of a step are recorded once. Nothing is read back between steps, but for checks of
// clustered bodies, where steps fall into parts or may be quiet, and sums that ranks exchange.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/collider.hpp"
#include "dynamics/grip.hpp"
#include "dynamics/pacer.hpp"
#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"
#include "simulation/cluster_watch.hpp"
#include "simulation/quiet_steps.hpp"
#include "simulation/skipping.hpp"
#include "simulation/step_passes.hpp"
#include "simulation/time_plan.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Why nothing moves any more: a vertex became non-finite, or its error ended a run with a tolerance. It is the first such
/// vertex.
struct Breakdown {
  std::uint64_t step = 0;              // in which it happened, counted from 1
  std::uint32_t body = 0, vertex = 0;  // the vertex counts within the body
  double failed_step = 0;              // length of the step whose error ended the run [s]; 0: no error did
  bool is_finite = false;              // all numbers of the state are
  bool takes_too_many = false;         // steps have become so short that more are left than a run may have

  bool operator==(const Breakdown&) const = default;
};

/// What a tolerance did to the steps.
struct AdaptiveReport {
  std::uint64_t rejected = 0;                  // steps undone: the error was too large, or touching vertices moved too far
  std::uint64_t rejected_in_contact = 0;       // rejected steps in which touching vertices moved too far against each other
  double smallest_step = 0, largest_step = 0;  // accepted steps [s]; 0: there are none
  double next_step = 0;                        // allowed length before it is fitted to a target [s]

  bool operator==(const AdaptiveReport&) const = default;
};

/// What the simulation did since its start.
struct StepReport {
  std::uint64_t steps = 0;  // completed steps, including the one of a breakdown, without rejected ones
  double time = 0;          // of the state [s]
  std::optional<AdaptiveReport> adaptive;
  std::optional<Breakdown> breakdown;
  std::uint64_t contact_steps = 0;      // steps with a contact, or parts of steps if they fall into such
  std::uint64_t contact_pairs_max = 0;  // most touching triangle pairs, or impulses, in one of them
  std::uint64_t reverted_vertices = 0;
  std::uint64_t substeps = 0;    // parts that steps of a fixed length fell into, beyond one each
  std::uint64_t held_parts = 0;  // parts of steps in which no body moved, because contacts were too many or not proven apart
  std::uint64_t unsettled_contacts = 0;   // sum over the run of those that still changed in a kick's last round
  ResponseReport response;                // what contacts gave and took
  std::uint64_t force_evaluations = 0;    // one evaluation is all forces of one body
  std::uint64_t pair_interactions = 0;    // N (N - 1) for each force evaluation, fewer if the body is clustered
  std::optional<ClusterReport> clusters;  // empty: no body is clustered
  std::uint64_t nodes_refitted = 0, node_tests = 0, triangle_tests = 0;
  std::uint64_t quiet_steps = 0;            // whole steps made many at once (quiet_steps.hpp)
  std::uint64_t pairs_beyond_capacity = 0;  // leaf pairs that the list had no room for, so that trees were descended twice
  std::uint64_t frame_changes = 0;          // how often a body's frame followed its rotation
  std::uint64_t forces_skipped = 0;         // force evaluations known to be zero because the body moves rigidly
  std::uint64_t steps_at_rest = 0;          // steps of one body in which it was left alone, because nothing moved it
  std::uint64_t steps_asleep = 0;           // steps of one body that slept
  std::uint64_t bodies_asleep = 0;          // now
  double energy_slept = 0;                  // that sleep has taken from motion [J]
  std::uint64_t body_pairs_skipped = 0;     // pairs of bodies that were not listed as near
  std::uint64_t refits_skipped = 0;         // trees whose body's box overlapped no other

  bool operator==(const StepReport&) const = default;
};

struct Intersections {
  std::uint64_t pairs = 0;            // pairs of triangles of different bodies that touch
  std::vector<std::uint32_t> bodies;  // bodies with a touching triangle, ascending
};

class Simulation {
 public:
  /// At most so many steps are queued before `stops` is asked, before parts of steps or quiet steps are counted, and with a
  /// tolerance before a report.
  static constexpr std::uint64_t most_steps_at_once = 32;

  /// `device` and `model` must outlive the simulation.
  Simulation(Device& device, const Model& model, const State& start, const TimePlan& plan, const CollisionDescription& collision);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Queues steps of a fixed length. They may still be running when this returns. After a breakdown nothing moves. If steps fall
  /// into parts, or some may be quiet, it waits for some of them now and then. It also waits at checks of clustered bodies, where
  /// it may make lists for seconds. With `stops` it waits, too, and asks. A yes ends it, perhaps in the midst of a step, where
  /// another call goes on.
  void advance(std::uint64_t steps, const std::function<bool()>& stops = {});
  /// Queues the next part of a step. It is a whole step unless the response divides it.
  void advance_part();
  /// With a tolerance: queues enough steps to reach `time` [s] if possible, but at most `most_steps`. Then it waits and
  /// reports. The step that reaches `time` ends there exactly, and queued steps after it are empty. The bits do not depend on
  /// how many steps are queued at a time.
  StepReport advance_toward(double time, std::uint64_t most_steps = most_steps_at_once);
  /// Goes on until report().time is `time` [s], or there was a breakdown.
  StepReport advance_to(double time);
  /// Turns on or off that steps measure the time of each pass. Measured steps are slower: see run_timed.
  void time_passes(bool timed = true) { timed_ = timed; }
  /// Says what steps leave out. Results are the same. Without this call it is everything.
  void skip(const Skipping& what);
  /// Returns the device time of all measured passes by kernel [s].
  [[nodiscard]] const std::map<std::string_view, double>& pass_seconds() const { return pass_seconds_; }
  /// Returns how many passes steps have launched: those that have items. Pulls, and what comes before the first step, do not
  /// count.
  [[nodiscard]] std::uint64_t launches_of_steps() const { return launches_of_steps_; }
  /// Queues a change of velocities between steps, as if the body had been pulled for `seconds` [s]. See Grip.
  void pull(const Pull& by, double seconds);
  /// Sends a scripted body along other keys, as many as before, from their time 0 on. They must begin where it is. Later steps
  /// go there, and saved states hold it.
  void send(std::uint32_t body, std::span<const physics::PathKey> keys);
  /// Gives scripted bodies of the same model the keys that they go along. Waits for the queued steps.
  void copy_path_keys(Model& into) const;
  /// The next two wait for the queued steps. They return what a scripted body does: the keys that it goes along, and where it is.
  [[nodiscard]] std::vector<physics::PathKey> path_keys(std::uint32_t body) const;
  [[nodiscard]] physics::PathState path_state(std::uint32_t body) const;
  /// The next six wait for the queued steps. The first says whether report() has a breakdown.
  [[nodiscard]] bool has_broken_down() { return control().non_finite_step != 0; }
  [[nodiscard]] StepReport report();
  [[nodiscard]] State state();
  /// Puts the state into one whose memory is used again.
  void read_state(State& into);
  [[nodiscard]] std::vector<glm::vec4> world_positions();
  /// Puts them into memory that is there, one for each vertex.
  void read_world_positions(std::span<glm::vec4> into);
  /// Returns by how much lists of clusters that were made anew have changed elastic energies: the sum of sizes [J], or NaN if
  /// there was no memory or thread to sum them. Waits until that is known.
  [[nodiscard]] double energy_changed_by_lists() { return watch_ ? watch_->energy_change() : 0; }
  /// Returns as bytes everything that the next steps and reports depend on. Waits for the queued steps, and for
  /// energy_changed_by_lists().
  [[nodiscard]] std::string save();
  /// Whether save() waits for queued steps alone.
  [[nodiscard]] bool can_save_soon() const { return !watch_ || watch_->knows_energy_change(); }
  /// Goes on from bytes of save(). The simulation that saved them must have the same bodies, plan and kind of collisions. On the
  /// same device it goes on bit for bit. Throws Error (input), without a place, if the bytes do not fit. The simulation can't be
  /// used after that.
  void restore(std::string_view saved);
  /// Returns the vertices that touched another body in the latest queued step. Waits for it.
  [[nodiscard]] std::vector<std::uint32_t> touching_vertices();
  /// Returns the impulses that contacts gave in the latest queued step, in no fixed order. An empty step keeps those of the step
  /// before. There are none after restore(), or if the response gives no impulses. Waits for the step.
  [[nodiscard]] std::vector<ContactImpulse> contact_impulses();
  /// Tests the current world positions with the scene's own search and triangle test.
  [[nodiscard]] Intersections intersections();

  /// The device's buffer of world positions, for drawing. The current ones begin at element first_position().
  [[nodiscard]] BufferId position_buffer() const { return bodies_.world_positions.id(); }
  [[nodiscard]] std::uint32_t first_position() { return bodies_.first_of_half(half()); }
  /// The device's buffer of motions: 6 doubles a vertex. The current ones also begin at vertex first_position().
  [[nodiscard]] BufferId motion_buffer() const { return bodies_.motions.id(); }
  [[nodiscard]] const Collider& collider() const { return collider_; }
  /// Of the device's numbers: 32 or 64.
  [[nodiscard]] int precision() const { return device_.precision(); }

 private:
  struct Progress {
    physics::Control control;
    std::uint64_t steps = 0;  // whole ones that stand, since the start
  };

  // Waits for the queued steps. Reads the arrays of these names at once, and from them how far steps have come.
  void read_progress(std::span<const std::string_view> arrays);
  [[nodiscard]] const physics::Control& control();  // waits for the queued steps
  [[nodiscard]] std::uint32_t half();               // the half that holds the current state
  [[nodiscard]] std::vector<Pass> schedule(std::uint32_t from_half) const;
  void queue(std::uint64_t steps);
  void queue_in_batches(std::uint64_t steps, const std::function<bool()>& stops);
  void run(std::span<const Pass> passes);
  void advance_unwatched(std::uint64_t steps, const std::function<bool()>& stops);
  void record();  // the passes of a step
  void watch(std::uint64_t steps);
  [[nodiscard]] bool tries_quiet_steps() const { return quiet_ && quiet_->are_known(); }
  [[nodiscard]] std::uint64_t whole_steps();  // that stand, since the start
  [[nodiscard]] std::uint64_t make_quiet_steps(std::uint64_t most);
  void add_pace(StepReport& report);
  void add_parts(StepReport& report) const;
  [[nodiscard]] const DeviceArray<physics::StepParts>* parts() const;

  Device& device_;
  const Model& model_;
  DeviceBodies bodies_;
  Stepper stepper_;
  Collider collider_;
  std::optional<Grip> grip_;           // of the latest pull
  std::optional<Pacer> pacer_;         // empty: steps have a fixed length
  physics::Pace known_pace_{};         // of the latest report
  double fixed_step_;                  // length of a step without a pacer [s]
  std::optional<QuietSteps> quiet_;    // empty: what is known beforehand is not left out
  std::optional<ClusterWatch> watch_;  // empty: no body is clustered
  Skipping skipped_;
  std::array<std::vector<Pass>, 2> schedules_;  // by the half that a step starts from
  std::optional<Progress> progress_;            // read once between steps; empty: not read yet
  std::uint64_t queued_steps_ = 0;              // including rejected and empty steps
  std::uint64_t steps_to_next_try_ = 0;         // of quiet ones
  std::uint64_t pause_ = 1;                     // steps to queue if the next try makes none
  bool timed_ = false, is_anew_ = true;         // anew: no step has been queued since the start or restore()
  std::map<std::string_view, double> pass_seconds_;
  std::uint64_t launches_of_steps_ = 0;
};

}  // namespace pliant
