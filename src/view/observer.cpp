#include "view/observer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/thread_pool.hpp"

namespace pliant::view {

void Series::add(double value) {
  if (values_.size() == most) values_.erase(values_.begin());
  values_.push_back(static_cast<float>(value));
}

void Observer::look(Session& session) {
  constexpr double interval = 0.1, largest_share = 0.1;  // [s], and the part of the time that samples may take
  const double began = clock_();
  if (began < next_ || session.breakdown()) return;
  if (!before_ || session.step() != before_->step) take_sample(session);
  const double ended = clock_();
  next_ = began + std::max(interval, (ended - began) / largest_share);
}

void Observer::forget() {
  observation_ = {};
  before_.reset();
  next_ = 0;
}

Observer::Counts Observer::count(Session& session) {
  return {session.step(), session.report().reverted_vertices, session.stepping(), session.simulation().pass_seconds()};
}

void Observer::take_sample(Session& session) {
  measure_energy(session);
  const Counts after = count(session);
  if (before_) note_contacts(session, *before_, after);
  if (before_) note_steps(*before_, after);
  before_ = after;
}

// Measures on one thread, because the others belong to the device.
void Observer::measure_energy(Session& session) {
  ThreadPool pool(1);
  const auto began = std::chrono::steady_clock::now();
  const Measurement measured =
      measure(session.model(), session.simulation().state(), session.scene().simulation.gravity, pool,
              [began] { return std::chrono::steady_clock::now() - began > std::chrono::milliseconds(30); });
  observation_.energy_is_known = std::isfinite(measured.energy());
  if (observation_.energy_is_known) observation_.energy.add(measured.energy());
}

void Observer::note_contacts(Session& session, const Counts& before, const Counts& after) {
  const bool goes_on = after.step >= before.step && after.touching >= before.touching;
  if (session.simulation().collider().response_row().gives_impulses)
    observation_.touching.add(static_cast<double>(session.simulation().contact_impulses().size()));
  else
    observation_.touching.add(goes_on ? static_cast<double>(after.touching - before.touching) : 0);
}

void Observer::note_steps(const Counts& before, const Counts& after) {
  const auto steps = static_cast<double>(after.stepping.steps - before.stepping.steps);
  if (steps == 0) return;
  observation_.step_milliseconds = 1e3 * (after.stepping.seconds - before.stepping.seconds) / steps;
  observation_.passes.clear();
  for (const auto& [name, seconds] : after.pass_seconds) {
    const auto earlier = before.pass_seconds.find(name);
    const double taken = seconds - (earlier == before.pass_seconds.end() ? 0 : earlier->second);
    if (taken > 0) observation_.passes.push_back({std::string(name), 1e3 * taken / steps});
  }
  std::ranges::sort(observation_.passes, std::ranges::greater(), &PassTime::milliseconds);
}

}  // namespace pliant::view
