// Simulates a scene for a viewer, with a way back.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/stopwatch.hpp"
#include "simulation/simulation.hpp"
#include "view/history.hpp"

namespace pliant::view {

struct LoadedScene {
  SceneDescription description;
  ModelAndState start;
  std::vector<std::string> warnings;  // about the meshes
};

/// Loads a scene file, or an OBJ file as a lone body with every default. An OBJ file takes no overrides. Throws Error.
[[nodiscard]] LoadedScene load(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The values of a scene that can change while it plays.
struct Settings {
  std::string integrator;
  std::optional<double> time_step;  // [s]; empty: automatic, or by the tolerance
  std::optional<double> tolerance;  // of steps that have no fixed length
  DampingLaw damping_law = DampingLaw::none;
  double elasticity = 0, friction = 0;  // of contacts, where a body has none of its own
  std::optional<double> restitution;
  std::vector<Material> materials;  // one a body
  bool operator==(const Settings&) const = default;
};

[[nodiscard]] Settings settings_of(const LoadedScene& scene);

/// A small sphere that presses into bodies where a mouse is.
struct Hand {
  std::uint32_t body = 0;
  double radius = 0;  // [m]
};

/// The steps made so far, including those made again on the way back.
struct Stepping {
  std::uint64_t steps = 0;
  double seconds = 0;  // wall time of these steps [s]
};

/// Goes on beyond the scene's duration. Every call waits until the device has done it.
class Session {
 public:
  static constexpr std::size_t history_bytes = std::size_t{256} << 20;  // most memory of the history

  /// `device` must outlive it. Throws Error if plan_time can't plan the scene's steps, the device has no room for the scene, or
  /// bodies intersect that the response keeps apart.
  Session(Device& device, LoadedScene scene, std::size_t most_history_bytes = history_bytes);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const SceneDescription& scene() const { return scene_->description; }
  [[nodiscard]] const Model& model() const { return scene_->start.model; }
  [[nodiscard]] const State& start() const { return scene_->start.state; }
  [[nodiscard]] Device& device() const { return *device_; }
  [[nodiscard]] Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] std::uint64_t step() const { return base_step_ + report_.steps; }
  [[nodiscard]] const StepReport& report() const { return report_; }  // since the latest start or change of settings
  [[nodiscard]] Stepping stepping() const { return {steps_made_, stepping_.seconds()}; }  // since the session began
  [[nodiscard]] double time() const;                                                      // of the state [s]
  [[nodiscard]] const TimePlan& plan() const { return plan_; }
  [[nodiscard]] std::optional<Breakdown> breakdown() const;  // its step counts like step()

  /// Returns whether there is a step to make toward `time` [s]. That is so if the next step ends at or before `time`. With a
  /// tolerance the next frame counts instead, because steps end at frames, whenever they are made. After a non-finite step
  /// nothing is due.
  [[nodiscard]] bool is_due(double time) const;
  /// Makes the steps that are due at `time` [s], but at most `most_steps`.
  void advance_toward(double time, std::uint64_t most_steps);
  /// Makes one step.
  void step_once();
  /// Makes later steps pull a body, or none if `by` is empty. A change of bodies ends it.
  void pull(const std::optional<Pull>& by) { pull_ = by; }
  [[nodiscard]] const std::optional<Pull>& pulled() const { return pull_; }
  /// Records the current state, to go back to. Copies it to the CPU.
  void record();
  /// Goes back by one step. It restores the latest state recorded before, and makes the steps in between again, without pulls,
  /// and without what the hand and shaken containers were sent since. The bits are the same if there was none of that. Returns
  /// false if no state is left.
  bool step_back();
  /// Goes back to the start. Bodies that were added are gone, and those that were removed are there again. Throws Error if the
  /// device has no room for them, and changes nothing.
  void restart();
  /// Returns the radius of the sphere around the scene's own bodies at the start [m].
  [[nodiscard]] double radius() const;
  [[nodiscard]] unsigned deepest_level() const { return simulation_->collider().forest().depth; }  // of the trees
  [[nodiscard]] Settings settings() const { return settings_of(*scene_); }
  /// Goes on from the current state with other settings, or from the start if that state is not finite. Recorded states are
  /// forgotten. If plan_time can't plan the scene's steps, or bodies intersect that the response keeps apart, it throws Error and
  /// changes nothing.
  void change(const Settings& wanted);
  /// Adds a body to the current state, and returns its index. Throws Error if it touches one that is there, or if the state is
  /// not finite, and changes nothing. Recorded states are forgotten.
  std::uint32_t add(const BodySetup& setup);
  /// Takes a body out of the current state, but not the last soft one. Recorded states are forgotten.
  void remove(std::uint32_t body);
  /// Moves containers to and fro for about a second, but those that the scene moves, or that are being shaken. They are scripted
  /// bodies from then on, until restart().
  void shake();
  /// Puts a hand there if there is none, or takes it away. Throws Error as add() does.
  void put_hand(const glm::dvec3& place, double radius);
  void take_hand();
  [[nodiscard]] const std::optional<Hand>& hand() const { return hand_; }
  /// Sends the hand there. It arrives after so long a time, if nothing is in its way [m], [s].
  void send_hand(const glm::dvec3& target, double seconds);
  /// Changes whenever bodies are others than before.
  [[nodiscard]] std::uint64_t bodies_version() const { return bodies_version_; }
  /// Turns on or off that the device's time is measured for each pass, which slows it down.
  void time_passes(bool timed);
  /// Goes on with the same state and history on another device of the same precision. `device` must outlive the session.
  void move_to(Device& device);

 private:
  [[nodiscard]] double time_of_step(std::uint64_t step) const {
    return base_time_ + static_cast<double>(step - base_step_) * plan_.time_step;
  }
  [[nodiscard]] std::uint64_t next_frame() const;
  [[nodiscard]] double time_of_frame(std::uint64_t frame) const { return static_cast<double>(frame) / plan_.frame_rate; }
  void make_due_steps(double time, std::uint64_t most_steps);
  [[nodiscard]] StepReport advance(double time, std::uint64_t most_steps);
  [[nodiscard]] std::unique_ptr<Simulation> simulation_on(Device& device, const State& from) const;
  void begin_with(std::unique_ptr<Simulation> simulation, std::uint64_t step, double time);
  void go_to(std::string_view saved);
  void go_on_with(LoadedScene changed, const State& from, bool starts_anew);
  void go_on_with_bodies(LoadedScene changed, const State& from);
  void bodies_are_others();
  [[nodiscard]] const LoadedScene& unedited() const { return before_edits_ ? *before_edits_ : *scene_; }
  [[nodiscard]] LoadedScene scene_now() const;     // with the paths that bodies were sent along
  void lay_hand_down(ModelAndState& start) const;  // gives it a path that rests where it was put
  [[nodiscard]] Settings settings_before_edits(const Settings& wanted) const;

  Device* device_;
  std::unique_ptr<const LoadedScene> scene_;         // other settings and bodies make another one, because a model never changes
  std::unique_ptr<const LoadedScene> before_edits_;  // what restart() goes back to; null: no bodies were added or removed
  std::uint64_t bodies_version_ = 0;
  std::optional<Hand> hand_;
  TimePlan plan_;
  std::unique_ptr<Simulation> simulation_;
  std::string beginning_;        // saved state at the start; empty: settings have been changed since
  StepReport report_;            // of the simulation
  std::uint64_t base_step_ = 0;  // at which the simulation began
  double base_time_ = 0;         // at which it began [s]
  History history_;
  std::optional<Pull> pull_;
  bool times_passes_ = false;
  std::uint64_t steps_made_ = 0;
  Stopwatch stepping_;
};

}  // namespace pliant::view
