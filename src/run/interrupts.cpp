#include "run/interrupts.hpp"

#include <atomic>
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

void note_interrupt(int) {
  std::int64_t first = 0;
  const std::int64_t now = nanoseconds_now();
  if (first_interrupt.compare_exchange_strong(first, now)) return;
  if (is_another_interrupt(std::chrono::nanoseconds(now - first))) std::_Exit(exit_interrupted);
}

}  // namespace

void watch_for_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

bool is_interrupted() { return first_interrupt != 0; }

}  // namespace pliant
