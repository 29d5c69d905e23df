#include "app/interrupts.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>

namespace pliant::app {
namespace {

std::atomic<std::time_t> first_interrupt{0};  // 0: none yet
static_assert(std::atomic<std::time_t>::is_always_lock_free, "a signal's handler may use it");

// Two that come together are one: `timeout` sends two.
void note_interrupt(int) {
  std::time_t first = 0;
  const std::time_t now = std::time(nullptr);
  if (!first_interrupt.compare_exchange_strong(first, now) && now > first + 1) std::_Exit(exit_interrupted);
}

}  // namespace

void watch_for_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

bool is_interrupted() { return first_interrupt != 0; }

}  // namespace pliant::app
