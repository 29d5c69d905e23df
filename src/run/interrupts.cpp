#include "run/interrupts.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace pliant {
namespace {

std::atomic<std::int64_t> first_interrupt{0};  // [ns] of the monotonic clock; 0: none yet
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "a signal's handler may use it");

// A signal handler may call clock_gettime.
std::int64_t nanoseconds_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

std::array<char, 256> told_end{};  // stays as it is once a handler may read it
std::size_t told_end_length = 0;

// A signal handler may call write. What it returns does not matter: there is no other way to tell.
void tell_end() {
  const int before = errno;
  static_cast<void>(!write(STDERR_FILENO, told_end.data(), told_end_length));
  errno = before;
}

void note_interrupt(int) {
  std::int64_t first = 0;
  const std::int64_t now = nanoseconds_now();
  if (first_interrupt.compare_exchange_strong(first, now)) return tell_end();
  if (is_another_interrupt(std::chrono::nanoseconds(now - first))) std::_Exit(exit_interrupted);
}

}  // namespace

void watch_for_interrupts(std::string_view work) {
  const auto told =
      fmt::format_to_n(told_end.data(), told_end.size(),
                       "{}pliant: ends after {}; another Ctrl-C, a second or more after the first, ends it at once\n",
                       isatty(STDERR_FILENO) != 0 ? "\n" : "", work);  // a bar of progress may stand in the line
  told_end_length = std::min(told.size, told_end.size());
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

void leave_interrupts_to_others() {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
}

bool is_interrupted() { return first_interrupt != 0; }

}  // namespace pliant
