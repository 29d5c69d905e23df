// Says when the simulation steps, so that its time keeps up with the clock. Callers pass every time, because it owns no clock.
#pragma once
#include <cstdint>
#include <optional>

namespace pliant::view {

struct Pace {
  double speed = 1;       // simulated time in a second of real time [s]
  double budget = 0.012;  // for stepping in one picture, so that the window reacts [s]; slow drawing raises it
};

/// For each picture, call begin(), step while the simulation is before goal() and has_time(), and call end(). Steps that do not
/// fit into the budget are made up for in later pictures. But the simulation is never behind by more than a tenth of a second: it
/// drops what is beyond. So a device that is too slow shows slow motion instead of ever longer pictures.
class Playback {
 public:
  explicit Playback(const Pace& pace) : pace_(pace) {}

  /// Begins a picture at `now` [s], with the simulation at `simulated` [s].
  void begin(double now, double simulated);
  /// Returns the latest time that the simulation may reach in this picture [s].
  [[nodiscard]] double goal() const { return goal_; }
  /// Returns whether the budget, counted from begin(), leaves time at `now` [s].
  [[nodiscard]] bool has_time(double now) const { return now - began_ < budget_; }
  /// Ends the steps of a picture at `now`, with the simulation at `simulated` [s]. `reached_goal` says that one more step would
  /// go beyond the goal.
  void end(double now, double simulated, bool reached_goal);

  /// Stops the clock of the playback. Steps during a pause do not count.
  void pause();
  void toggle_pause();
  [[nodiscard]] bool is_paused() const { return paused_; }
  /// Goes on from another time of the simulation.
  void restart() { in_stretch_ = false; }

  /// Returns the simulated time that was dropped since the playback was made [s].
  [[nodiscard]] double dropped() const { return dropped_; }
  /// Returns the speed, less the share of time that was dropped in a span of half a second or more.
  [[nodiscard]] double factor() const { return slow_factor_.value_or(pace_.speed); }
  [[nodiscard]] double speed() const { return pace_.speed; }
  /// What the simulation is behind stays as much real time as it was.
  void set_speed(double speed);

 private:
  struct Span {                     // stretch of time over which the factor is measured
    double began = 0, dropped = 0;  // of real time [s]
  };
  void measure(double now);

  Pace pace_;
  bool paused_ = false;
  bool in_stretch_ = false;                  // false: the next picture is the first since the start, a pause or a restart
  double began_ = 0, ended_ = 0, goal_ = 0;  // of this picture's steps [s]
  double budget_ = 0;                        // in this picture [s]
  double behind_ = 0;                        // at the end of the latest picture's steps [s]
  double dropped_ = 0;                       // in all pictures [s]
  Span span_;
  std::optional<double> slow_factor_;
};

/// Chooses how many steps to make between two looks at the clock. They take about a sixth of a usual budget, because each look
/// waits for the device.
class BatchSize {
 public:
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  /// Tells it how long steps() steps took [s].
  void took(double seconds);

 private:
  std::uint64_t steps_ = 1;
};

}  // namespace pliant::view
