// Threads that share the items of one loop after another. A step is some twenty short loops, and so pliant has its own pool:
// - A loop ends when its items are done. It does not wait for threads that have not woken up for it.
// - If there is a processor for each thread, threads look for the next loop for some 50 us before they sleep.
// - If there are exactly as many processors as threads, each worker stays on its own processor (Linux).
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace pliant {

/// Returns how many threads a pool of `asked` threads has. 0 asks for one for each processor that this thread may run on.
[[nodiscard]] unsigned thread_count(unsigned asked);

class ThreadPool {
 public:
  /// The ranges of a loop that one thread takes, one after another.
  class Ranges;
  /// Is called once on each thread that takes part in a loop. It has to take ranges until there are no more, or the loop would
  /// not end. The calling thread may find none.
  using Part = std::function<void(Ranges&)>;
  /// Is called with the first item of a range and one past its last.
  using Body = std::function<void(std::uint32_t, std::uint32_t)>;

  /// `threads` includes the calling one. 0 asks for one per processor. Throws Error (device) if the system gives fewer.
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Shares ranges of at most `grain` items that cover 0 to count - 1 among threads, in any order. Returns when all are done. The
  /// part must not throw. One thread at a time may call this. Expects count < 2^32 - 1.
  void share(std::uint32_t count, std::uint32_t grain, const Part& part);
  /// The same, with a body that is called for each range.
  void for_ranges(std::uint32_t count, std::uint32_t grain, const Body& body);

 private:
  void stop();
  void work();
  void take_part();
  void await_change(const std::atomic<std::uint32_t>& value, std::uint32_t from) const;

  std::vector<std::thread> workers_;
  // What threads write while others read stands on cache lines of its own.
  std::atomic<const Part*> part_{nullptr};
  std::atomic<std::uint32_t> count_{0}, grain_{1};
  alignas(64) std::atomic<std::uint64_t> next_;  // high half: the loop's number, low half: its first item that nobody has taken
  alignas(64) std::atomic<std::uint32_t> done_{0};  // items finished by threads that found no more to take
  alignas(64) std::atomic<std::uint32_t> loop_{0};  // number of the latest loop, whose change wakes the workers
  std::atomic<bool> stopping_{false};
  bool own_processors_ = false;  // whether there is a processor for each thread
};

class ThreadPool::Ranges {
 public:
  /// Says in `first` and `end` which items come next. Returns false if there are no more.
  bool take(std::uint32_t& first, std::uint32_t& end) {
    if (first_ == end_ && !take_more()) return false;
    first = first_;
    first_ += std::min(grain_, end_ - first_);
    end = first_;
    return true;
  }

 private:
  friend ThreadPool;
  explicit Ranges(ThreadPool& pool) : pool_(&pool) {}
  // All items, for a thread that has nobody to share them with.
  Ranges(std::uint32_t count, std::uint32_t grain) : end_(count), grain_(grain) {}
  bool take_more();

  ThreadPool* pool_ = nullptr;           // null if this thread has all items from the start
  std::uint32_t first_ = 0, end_ = 0;    // of items that this thread has and take() has not returned yet
  std::uint32_t grain_ = 1;              // most items of a range
  std::uint32_t taken_ = 0, count_ = 0;  // with a pool: items that this thread took from it so far, and all of the loop
};

}  // namespace pliant
