// Observes a simulation for a viewer. It reads back and measures only while somebody looks.
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

/// The latest numbers of a plot.
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
  double milliseconds = 0;  // device time in a step
};

struct Observation {
  Series energy;                 // of all bodies [J]
  bool energy_is_known = true;   // false: there are too many springs to measure it live
  Series touching;               // contacts with an impulse in the latest step, or vertices turned back between two samples
  std::vector<PassTime> passes;  // longest first; empty: not timed
  double step_milliseconds = 0;  // mean time of a step over the latest samples; 0: none was made
};

class Observer {
 public:
  /// `clock` gives the time from any origin [s].
  explicit Observer(std::function<double()> clock) : clock_(std::move(clock)) {}

  /// Takes a sample if the latest one began at least a tenth of a second ago. A sample that took longer than 10 ms delays the
  /// next one to ten times as long.
  void look(Session& session);
  /// Drops what happens before the next sample from the counts. Call it if nobody looked meanwhile or the simulation is another.
  void count_anew() { before_.reset(); }
  /// Forgets all samples. Call it for another scene or another start.
  void forget();
  [[nodiscard]] const Observation& observation() const { return observation_; }

 private:
  struct Counts {  // sums since the start
    std::uint64_t step = 0, touching = 0;
    Stepping stepping;
    std::map<std::string_view, double> pass_seconds;
  };
  [[nodiscard]] static Counts count(Session& session);
  void take_sample(Session& session);
  void measure_energy(Session& session);
  void note_contacts(Session& session, const Counts& before, const Counts& after);
  void note_steps(const Counts& before, const Counts& after);

  std::function<double()> clock_;
  Observation observation_;
  double next_ = 0;               // time of the next sample [s]
  std::optional<Counts> before_;  // at the latest sample; empty: the next one is the first
};

}  // namespace pliant::view
