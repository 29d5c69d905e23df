// Sums the wall time between start() and stop().
#pragma once
#include <chrono>

namespace pliant {

class Stopwatch {
 public:
  void start() { begin_ = Clock::now(); }
  void stop() { total_ += Clock::now() - begin_; }
  void add(const Stopwatch& other) { total_ += other.total_; }
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(total_).count(); }

  /// Times one call and returns what it returns.
  template <class F>
  decltype(auto) time(F&& call) {
    struct Span {
      Stopwatch& watch;
      explicit Span(Stopwatch& w) : watch(w) { watch.start(); }
      ~Span() { watch.stop(); }
    } span(*this);
    return call();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_{};
  Clock::duration total_{};
};

}  // namespace pliant
