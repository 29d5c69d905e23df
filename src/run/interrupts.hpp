// What Ctrl-C and SIGTERM do, in every command that takes long.
#pragma once
#include <chrono>

namespace pliant {

inline constexpr int exit_interrupted = 130;  // as shells have it after Ctrl-C

/// From here on the first Ctrl-C or SIGTERM asks for an early end, after what is in hand; another one, a second or more later,
/// ends the program at once. Until it is called, the first one ends it.
void watch_for_interrupts();

/// Whether to come to an end. Any thread may ask.
[[nodiscard]] bool is_interrupted();

/// Whether an interrupt so long after the first is another one: `timeout` sends two together, which are one.
[[nodiscard]] constexpr bool is_another_interrupt(std::chrono::nanoseconds after_first) {
  return after_first >= std::chrono::seconds(1);
}

}  // namespace pliant
