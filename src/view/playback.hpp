// When the simulation steps, so that its time goes with the clock's. Owns no clock: every time of it is an argument.
#pragma once
#include <cstdint>
#include <optional>

namespace pliant::view {

struct Pace {
  double speed = 1;       // simulated time in a second of real time [s]
  double budget = 0.012;  // for stepping in one picture [s], so that the window stays awake; more where drawing takes longer
};

/// For each picture: begin(), steps as long as the simulation is before goal() and has_time(), end(). What does not fit the
/// budget is let go, so that a device that is too slow shows slow motion instead of ever longer pictures.
class Playback {
 public:
  explicit Playback(const Pace& pace) : pace_(pace) {}

  /// Begins a picture at `now` [s], with the simulation at `simulated` [s].
  void begin(double now, double simulated);
  /// The latest time at which the simulation may be in this picture [s].
  [[nodiscard]] double goal() const { return goal_; }
  /// Whether the budget, counted from begin(), leaves time at `now` [s].
  [[nodiscard]] bool has_time(double now) const { return now - began_ < budget_; }
  /// Ends the steps of a picture at `now`, with the simulation at `simulated` [s]; `reached_goal`: one more step would go beyond
  /// it.
  void end(double now, double simulated, bool reached_goal);

  /// What happens while paused takes no time.
  void pause();
  void toggle_pause();
  [[nodiscard]] bool is_paused() const { return paused_; }
  /// The simulation has been put to another time: goes on from there.
  void restart() { in_stretch_ = false; }

  /// Simulated by real time: the speed or, where the device does not keep up, what it was over half a second or more.
  [[nodiscard]] double factor() const { return slow_factor_.value_or(pace_.speed); }
  [[nodiscard]] double speed() const { return pace_.speed; }
  void set_speed(double speed) { pace_.speed = speed; }

 private:
  struct Span {                       // over which the factor is measured
    double began = 0, simulated = 0;  // [s]
    bool was_behind = false;          // in a picture of it
  };
  void measure(double now, double simulated);

  Pace pace_;
  bool paused_ = false;
  bool in_stretch_ = false;                  // else the next picture is the first one since the start or a pause
  double began_ = 0, ended_ = 0, goal_ = 0;  // of this picture's steps [s]
  double budget_ = 0;                        // in this picture [s]
  Span span_;
  std::optional<double> slow_factor_;
};

/// How many steps to make between two looks at the clock: as many as take a sixth of a usual budget, more or less, since each
/// look waits for the device.
class BatchSize {
 public:
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  /// So long they took [s].
  void took(double seconds);

 private:
  std::uint64_t steps_ = 1;
};

}  // namespace pliant::view
