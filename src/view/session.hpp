// A scene that is being simulated, with a way back: what a viewer shows.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/simulation.hpp"
#include "view/history.hpp"

namespace pliant::view {

/// A scene file's description; that of a lone body with every default for an OBJ file, which takes no overrides. Throws Error.
[[nodiscard]] SceneDescription describe(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Goes on beyond the scene's duration. Every call waits until the device has done it.
class Session {
 public:
  static constexpr std::size_t history_bytes = std::size_t{256} << 20;  // at most, for going back

  /// `device` must outlive it. Throws Error where the scene can't be loaded, or the device has no room for it.
  Session(Device& device, SceneDescription scene, std::size_t most_history_bytes = history_bytes);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const SceneDescription& scene() const { return scene_; }
  [[nodiscard]] const std::string& title() const { return scene_.title; }
  [[nodiscard]] const Model& model() const { return start_.model; }
  [[nodiscard]] const State& start() const { return start_.state; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }  // of the meshes
  [[nodiscard]] Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] std::uint64_t step() const { return base_step_ + report_.steps; }
  [[nodiscard]] double time() const;  // of the state [s]
  [[nodiscard]] const std::optional<NonFinite>& non_finite() const { return report_.non_finite; }

  /// Whether a state beyond this one is due at `time` [s]: the next step or, with a tolerance, the next frame, which is where
  /// steps end then whenever they are made. Never after a step that was not finite.
  [[nodiscard]] bool is_before(double time) const;
  /// Makes at most `most_steps` of those that are due at `time` [s].
  void advance_toward(double time, std::uint64_t most_steps);
  /// Makes one step.
  void step_once();
  /// Records the state as it stands, to go back to. It visits the CPU for that.
  void record();
  /// Back by one step: to the state recorded last before it, and on from there if steps lie between. With a tolerance to the
  /// recorded state itself, since steps made anew have other lengths. False where none is left.
  bool step_back();
  /// Back to the start.
  void restart();

 private:
  [[nodiscard]] double time_of_step(std::uint64_t step) const { return static_cast<double>(step) * plan_.time_step; }
  [[nodiscard]] std::uint64_t next_frame() const;
  [[nodiscard]] double time_of_frame(std::uint64_t frame) const { return static_cast<double>(frame) / plan_.frame_rate; }
  void start_from(const State& state, std::uint64_t step, double time);

  Device& device_;
  SceneDescription scene_;
  std::vector<std::string> warnings_;
  ModelAndState start_;
  TimePlan plan_;
  std::unique_ptr<Simulation> simulation_;
  StepReport report_;  // of the simulation, which began at:
  std::uint64_t base_step_ = 0;
  double base_time_ = 0;  // [s]
  History history_;
};

}  // namespace pliant::view
