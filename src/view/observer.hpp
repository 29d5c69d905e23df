// What a viewer tells of a simulation: read back, measured and kept only while somebody looks.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/thread_pool.hpp"
#include "simulation/measure.hpp"
#include "view/session.hpp"

namespace pliant::view {

/// The latest numbers, as many as a plot shows.
class Series {
 public:
  static constexpr std::size_t most = 240;
  void add(double value);
  [[nodiscard]] const std::vector<float>& values() const { return values_; }

 private:
  std::vector<float> values_;
};

struct PassTime {
  std::string name;
  double milliseconds = 0;  // of the device, a step
};

struct Observation {
  Series energy;                 // of all bodies [J]
  bool energy_is_known = true;   // else there are too many springs to measure it live
  Series touching;               // vertices that contacts held back since the sample before
  std::vector<PassTime> passes;  // while they are timed
  double step_milliseconds = 0;  // a step took, over the latest samples; 0: none was made
};

class Observer {
 public:
  /// Takes a sample where the latest one is a tenth of a second old, or ten times as old as it took to take; `now` from any
  /// origin [s].
  void look(Session& session, double now);
  /// So long stepping took [s].
  void add_stepping(double seconds) { stepping_seconds_ += seconds; }
  [[nodiscard]] const Observation& observation() const { return observation_; }
  /// Of another scene, or from another start.
  void forget() { *this = Observer(); }

 private:
  void measure_energy(Session& session);
  void count(Session& session);
  void note_passes(const Simulation& simulation, std::uint64_t steps);

  Observation observation_;
  double next_ = 0;  // [s]
  double stepping_seconds_ = 0;
  std::uint64_t steps_before_ = 0, reverted_before_ = 0;
  std::map<std::string_view, double> pass_seconds_before_;
};

}  // namespace pliant::view
