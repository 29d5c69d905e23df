// A loop is handed over by counting `loop_` up; its end is `running_` reaching zero.
#include "core/thread_pool.hpp"

#include <algorithm>

namespace pliant {

ThreadPool::ThreadPool(unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
}

ThreadPool::~ThreadPool() {
  stopping_ = true;
  ++loop_;
  loop_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::for_ranges(std::uint32_t count, std::uint32_t grain,
                            const std::function<void(std::uint32_t, std::uint32_t)>& body) {
  if (workers_.empty() || count <= grain) {
    for (std::uint32_t first = 0; first < count; first += std::min(grain, count - first))
      body(first, std::min(first + grain, count));
    return;
  }
  body_ = &body;
  count_ = count;
  grain_ = grain;
  next_ = 0;
  running_ = static_cast<std::uint32_t>(workers_.size());
  ++loop_;
  loop_.notify_all();
  take_ranges();
  for (std::uint32_t left = running_; left != 0; left = running_) running_.wait(left);
}

void ThreadPool::work() {
  std::uint32_t seen = 0;
  while (true) {
    loop_.wait(seen);
    seen = loop_;
    if (stopping_) return;
    take_ranges();
    if (--running_ == 0) running_.notify_one();
  }
}

void ThreadPool::take_ranges() {
  while (true) {
    const std::uint64_t first = next_.fetch_add(grain_);
    if (first >= count_) return;
    (*body_)(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::min<std::uint64_t>(first + grain_, count_)));
  }
}

}  // namespace pliant
