// A scene that is being simulated, with a way back: what a viewer shows.
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
  std::vector<std::string> warnings;  // of the meshes
};

/// A scene file, or an OBJ file as a lone body with every default, which takes no overrides. Throws Error.
[[nodiscard]] LoadedScene load(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// What of a scene can be changed while it plays.
struct Settings {
  std::string integrator;
  std::optional<double> time_step;  // [s]; empty: automatic, or by the scene's tolerance
  DampingLaw damping_law = DampingLaw::none;
  double elasticity = 0;
  std::vector<Material> materials;  // of the bodies
  bool operator==(const Settings&) const = default;
};

/// Steps that were made, those made anew on the way back among them.
struct Stepping {
  std::uint64_t steps = 0;
  double seconds = 0;  // that they took [s]
};

/// Goes on beyond the scene's duration. Every call waits until the device has done it.
class Session {
 public:
  static constexpr std::size_t history_bytes = std::size_t{256} << 20;  // at most, for going back

  /// `device` must outlive it. Throws Error where there is no plan for the scene's steps, or the device has no room for it.
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
  [[nodiscard]] std::optional<NonFinite> non_finite() const;  // its step counts as step() does

  /// Whether there is a step to make for the state at `time` [s]: the next one or, with a tolerance, the next frame, which is
  /// where steps end then whenever they are made. Never after a step that was not finite.
  [[nodiscard]] bool is_due(double time) const;
  /// Makes at most `most_steps` of those that are due at `time` [s].
  void advance_toward(double time, std::uint64_t most_steps);
  /// Makes one step.
  void step_once();
  /// From here on steps draw a body; empty: none.
  void pull(const std::optional<Pull>& by) { pull_ = by; }
  /// Records the state as it stands, to go back to. It visits the CPU for that.
  void record();
  /// Back by one step, to the very bits: to the state recorded last before it, and on from there if steps lie between, though
  /// without pulls. False where none is left.
  bool step_back();
  /// Back to the start.
  void restart();
  [[nodiscard]] unsigned deepest_level() const { return simulation_->collider().forest().depth; }  // of the trees
  [[nodiscard]] Settings settings() const;
  /// Goes on from the state as it stands, or from the start if it is not finite; the ways back before are forgotten. Throws
  /// Error, with all as it was, where there is no plan for the scene's steps.
  void change(const Settings& wanted);
  /// Whether the device's time is taken for each pass, which slows it down.
  void time_passes(bool timed);
  /// Goes on on another device of the same precision, with the very state, and so do all ways back. `device` must outlive it.
  void move_to(Device& device);

 private:
  [[nodiscard]] double time_of_step(std::uint64_t step) const {
    return base_time_ + static_cast<double>(step - base_step_) * plan_.time_step;
  }
  [[nodiscard]] std::uint64_t next_frame() const;
  [[nodiscard]] double time_of_frame(std::uint64_t frame) const { return static_cast<double>(frame) / plan_.frame_rate; }
  void make_due_steps(double time, std::uint64_t most_steps);
  [[nodiscard]] StepReport advance(double time, std::uint64_t most_steps);
  /// Of this session's scene, by its plan.
  [[nodiscard]] std::unique_ptr<Simulation> simulation_on(Device& device, const State& from) const;
  void begin_with(std::unique_ptr<Simulation> simulation, std::uint64_t step, double time);
  void go_to(std::string_view saved);

  Device* device_;
  std::unique_ptr<const LoadedScene> scene_;  // other settings make another one, for a model never changes
  TimePlan plan_;
  std::unique_ptr<Simulation> simulation_;
  std::string beginning_;  // its state at the start, saved; empty: settings have been changed since
  StepReport report_;      // of the simulation, which began at:
  std::uint64_t base_step_ = 0;
  double base_time_ = 0;  // [s]
  History history_;
  std::optional<Pull> pull_;
  bool times_passes_ = false;
  std::uint64_t steps_made_ = 0;
  Stopwatch stepping_;
};

}  // namespace pliant::view
