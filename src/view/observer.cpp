#include "view/observer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/stopwatch.hpp"

namespace pliant::view {

void Series::add(double value) {
  if (values_.size() == most) values_.erase(values_.begin());
  values_.push_back(static_cast<float>(value));
}

void Observer::look(Session& session, double now) {
  constexpr double interval = 0.1, largest_share = 0.1;  // [s], of the time
  if (now < next_ || session.non_finite()) return;
  Stopwatch watch;
  watch.start();
  if (session.step() != steps_before_ || observation_.energy.values().empty()) {
    measure_energy(session);
    count(session);
  }
  watch.stop();
  next_ = now + std::max(interval, watch.seconds() / largest_share);
}

// On one thread: the others belong to the device.
void Observer::measure_energy(Session& session) {
  ThreadPool pool(1);
  const auto began = std::chrono::steady_clock::now();
  const Measurement measured =
      measure(session.model(), session.simulation().state(), session.scene().simulation.gravity, pool,
              [began] { return std::chrono::steady_clock::now() - began > std::chrono::milliseconds(30); });
  observation_.energy_is_known = std::isfinite(measured.energy());
  if (observation_.energy_is_known) observation_.energy.add(measured.energy());
}

void Observer::count(Session& session) {
  const std::uint64_t steps = session.step(), reverted = session.report().reverted_vertices;
  const bool goes_on = steps >= steps_before_ && reverted >= reverted_before_;
  observation_.touching.add(goes_on ? static_cast<double>(reverted - reverted_before_) : 0);
  if (steps > steps_before_) {
    observation_.step_milliseconds = 1e3 * stepping_seconds_ / static_cast<double>(steps - steps_before_);
    note_passes(session.simulation(), steps - steps_before_);
  }
  steps_before_ = steps;
  reverted_before_ = reverted;
  stepping_seconds_ = 0;
}

void Observer::note_passes(const Simulation& simulation, std::uint64_t steps) {
  observation_.passes.clear();
  for (const auto& [name, seconds] : simulation.pass_seconds()) {
    const double taken = seconds - pass_seconds_before_[name];
    pass_seconds_before_[name] = seconds;
    if (taken > 0) observation_.passes.push_back({std::string(name), 1e3 * taken / static_cast<double>(steps)});
  }
  std::ranges::sort(observation_.passes, std::ranges::greater(), &PassTime::milliseconds);
}

}  // namespace pliant::view
