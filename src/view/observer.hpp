// What a viewer tells of a simulation: read back, measured and kept only while somebody looks.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
  Series touching;               // vertices that contacts held back from one sample to the next
  std::vector<PassTime> passes;  // while they are timed
  double step_milliseconds = 0;  // a step took, over the latest samples; 0: none was seen
};

class Observer {
 public:
  /// `clock` gives the time from any origin [s].
  explicit Observer(std::function<double()> clock) : clock_(std::move(clock)) {}

  /// Takes a sample where the latest one began a tenth of a second ago, or ten times as long ago as it took to take.
  void look(Session& session);
  /// What happens before the next sample is not counted: nobody looked, or the simulation is another.
  void count_anew() { before_.reset(); }
  /// Of another scene, or from another start.
  void forget();
  [[nodiscard]] const Observation& observation() const { return observation_; }

 private:
  struct Counts {  // all of them sums
    std::uint64_t step = 0, touching = 0;
    Stepping stepping;
    std::map<std::string_view, double> pass_seconds;
  };
  [[nodiscard]] static Counts count(Session& session);
  void take_sample(Session& session);
  void measure_energy(Session& session);
  void note_steps(const Counts& before, const Counts& after);

  std::function<double()> clock_;
  Observation observation_;
  double next_ = 0;               // [s]
  std::optional<Counts> before_;  // at the latest sample; empty: the next one is the first
};

}  // namespace pliant::view
