// Handles Ctrl-C and SIGTERM in commands that take long.
#pragma once
#include <chrono>
#include <string_view>

namespace pliant {

inline constexpr int exit_interrupted = 130;  // the code that shells use after Ctrl-C

/// After this call the first Ctrl-C or SIGTERM asks for an early end, and the current work is finished first. It says so on
/// standard error, at once: `work` is what is finished, such as "the steps in hand". Another one, a second or more later, ends
/// the program at once. Before this call the first one ends it at once.
void watch_for_interrupts(std::string_view work);

/// After this call this process ignores both.
void leave_interrupts_to_others();

/// Returns whether the program should come to an end. Any thread may ask.
[[nodiscard]] bool is_interrupted();

/// Returns whether an interrupt so long after the first counts as another one. `timeout` sends two together, which count as one.
[[nodiscard]] constexpr bool is_another_interrupt(std::chrono::nanoseconds after_first) {
  return after_first >= std::chrono::seconds(1);
}

}  // namespace pliant
