#include "view/playback.hpp"

#include <algorithm>

namespace pliant::view {

// If a picture takes longer to draw than a display to refresh, steps may take as long as the excess.
void Playback::begin(double now, double simulated) {
  constexpr double refresh = 1.0 / 60;  // [s]
  budget_ = pace_.budget;
  if (in_stretch_ && !paused_) {
    budget_ = std::max(budget_, now - ended_ - refresh);
    goal_ += (now - began_) * pace_.speed;
    measure(now);
  } else {
    goal_ = simulated;
    span_ = {now};
    in_stretch_ = !paused_;
  }
  began_ = now;
}

void Playback::end(double now, double simulated, bool reached_goal) {
  constexpr double longest_behind = 0.1;  // of real time [s]
  ended_ = now;
  const double latest_goal = simulated + longest_behind * pace_.speed;
  behind_ = reached_goal ? 0 : std::min(goal_, latest_goal) - simulated;
  if (reached_goal || goal_ <= latest_goal) return;
  dropped_ += goal_ - latest_goal;
  span_.dropped += (goal_ - latest_goal) / pace_.speed;
  goal_ = latest_goal;
}

void Playback::set_speed(double speed) {
  const double behind = pace_.speed > 0 ? behind_ * speed / pace_.speed : 0;
  goal_ += behind - behind_;
  behind_ = behind;
  pace_.speed = speed;
}

void Playback::pause() {
  paused_ = true;
  in_stretch_ = false;
}

void Playback::toggle_pause() {
  if (paused_)
    paused_ = false;
  else
    pause();
}

void Playback::measure(double now) {
  constexpr double long_enough = 0.5;  // [s]
  const double seconds = now - span_.began;
  if (seconds < long_enough) return;
  slow_factor_.reset();
  if (span_.dropped > 0) slow_factor_ = pace_.speed * std::max(0.0, 1 - span_.dropped / seconds);
  span_ = {now};
}

void BatchSize::took(double seconds) {
  constexpr double short_time = 0.001, long_time = 0.003;  // [s]
  constexpr std::uint64_t most = 32;
  if (seconds < short_time)
    steps_ = std::min(2 * steps_, most);
  else if (seconds > long_time)
    steps_ = std::max<std::uint64_t>(steps_ / 2, 1);
}

}  // namespace pliant::view
