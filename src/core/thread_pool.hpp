// Threads that share the items of one loop after another. Written here rather than taken from a library because a step is some
// twenty short loops, and so that thread sanitizers see every hand-over.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace pliant {

class ThreadPool {
 public:
  /// `threads` counts the calling one; 0: one a processor.
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }

  /// Calls body(first, end) for ranges that cover 0 to count - 1, in any order on any thread; returns when all are done.
  /// Ranges hold at most `grain` items. The body must not throw.
  void for_ranges(std::uint32_t count, std::uint32_t grain, const std::function<void(std::uint32_t, std::uint32_t)>& body);

 private:
  void work();
  void take_ranges();

  std::vector<std::thread> workers_;
  const std::function<void(std::uint32_t, std::uint32_t)>* body_ = nullptr;
  std::uint32_t count_ = 0, grain_ = 1;
  std::atomic<std::uint64_t> next_{0};     // first item nobody has taken
  std::atomic<std::uint32_t> loop_{0};     // counts the loops; a change wakes the workers
  std::atomic<std::uint32_t> running_{0};  // workers still in the loop
  std::atomic<bool> stopping_{false};
};

}  // namespace pliant
