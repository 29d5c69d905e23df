// A scene that a program drives: it steps, reads, changes, saves and draws as the program asks.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "render/image.hpp"
#include "run/batch.hpp"
#include "run/painter.hpp"
#include "run/prepared_run.hpp"
#include "simulation/measure.hpp"

namespace pliant {

/// Steps give the bits of `pliant run`. One thread at a time may use it. What uses OpenGL belongs to a thread: a run on a GPU to
/// the one that made it, and another run, once it has drawn, to the one that drew first. That thread has to destroy it, too. In
/// another one all calls throw Error (device), and change nothing.
class DrivenRun {
 public:
  /// Returns true to end what takes long.
  using Stops = std::function<bool()>;

  /// Throws Error as prepare_run does.
  explicit DrivenRun(const RunOptions& options);
  ~DrivenRun();
  DrivenRun(const DrivenRun&) = delete;
  DrivenRun& operator=(const DrivenRun&) = delete;

  [[nodiscard]] const SceneDescription& scene() const { return run_->scene; }
  [[nodiscard]] const Model& model() const { return run_->start.model; }
  [[nodiscard]] const TimePlan& plan() const { return run_->plan; }
  [[nodiscard]] const Device& device() const { return *run_->device; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return run_->warnings; }  // of the scene

  /// Makes whole steps. After a breakdown nothing moves. A single step may still be running on a GPU when this returns. `stops`
  /// is asked about ten times a second while there are more, but no more often than each 32 steps. It may end them within a step,
  /// where the next call goes on. With a tolerance steps end at the scene's frames, as those of `pliant run` do.
  void advance(std::uint64_t steps, const Stops& stops = {});
  /// Goes on to `time` [s], which must not be before now. Steps of a fixed length go on to the step that ends nearest to it.
  void advance_to(double time, const Stops& stops = {});
  /// Whether numbers went wrong. Waits for the queued steps.
  [[nodiscard]] bool has_broken_down();

  /// The next four wait for the queued steps. Steps and times of the report count from the start, all else from the latest
  /// change of state or material.
  [[nodiscard]] StepReport report();
  [[nodiscard]] const State& state();  // valid until the next call
  [[nodiscard]] Measurement measure();
  [[nodiscard]] Simulation& simulation();  // to read from

  /// /// Goes on with another state, or with other materials, one for each body. Throws Error, and changes nothing, if bodies
  /// intersect that the response keeps apart, if the scene's steps can't be planned, or after a breakdown.
  void go_on_with(const State& state);
  void go_on_with(std::span<const Material> materials);
  /// Pulls a body by one of its vertices, as if for `seconds` [s]. See Grip. Throws Error (input) if the body has no springs.
  void pull(const Pull& by, double seconds);
  /// Lets a scripted body go from where it is to another place of its centre [m], within `seconds` [s], and rest there. Throws
  /// Error (input) if it has no path of its own.
  void send(std::uint32_t body, const glm::dvec3& target, double seconds);

  /// Returns all that goes on from here depends on, as bytes.
  [[nodiscard]] std::string save();
  /// Goes on from bytes of save(), of this run or another one of the same scene. On the same device it goes on bit for bit.
  /// Throws Error (input), and changes nothing, if bytes are damaged, or of another scene or pliant.
  void restore(std::string_view saved);

  /// Draws the bodies as they are, as frames are drawn. Throws Error (device) where there is no OpenGL.
  [[nodiscard]] render::Image render(const OutputDescription& output);

  /// Whether it belongs to another thread than the calling one.
  [[nodiscard]] bool is_of_another_thread() const { return owner_ && *owner_ != std::this_thread::get_id(); }

 private:
  [[nodiscard]] std::unique_ptr<PreparedRun> with(Model model, const State& state) const;
  void take(std::unique_ptr<PreparedRun> run, std::uint64_t steps, double time);
  void go_on_with(Model model, const State& state);
  void advance_adaptive(std::uint64_t steps, const Stops& stops);
  [[nodiscard]] double next_frame(double time) const;
  void enter();
  [[nodiscard]] std::uint64_t fingerprint() const;

  std::unique_ptr<PreparedRun> run_;
  std::optional<std::thread::id> owner_;  // the thread that it belongs to
  std::uint64_t base_step_ = 0;           // at which the simulation began
  double base_time_ = 0;                  // at which it began [s]
  Batch batch_;
  State state_;
  std::unique_ptr<Meter> meter_;
  std::unique_ptr<ThreadPool> pool_;
  OutputDescription painted_;  // what the painter was made for
  std::unique_ptr<Painter> painter_;
};

}  // namespace pliant
