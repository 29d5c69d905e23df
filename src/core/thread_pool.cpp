// Between loops `next_` says closed, so a late thread can never take an item by the count of another loop.
#include "core/thread_pool.hpp"

#include <algorithm>
#include <exception>
#include <string>

#include "core/error.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t closed = 0xffffffffu;

constexpr std::uint64_t place(std::uint32_t loop, std::uint32_t item) { return (static_cast<std::uint64_t>(loop) << 32) | item; }
constexpr std::uint32_t item_of(std::uint64_t place) { return static_cast<std::uint32_t>(place); }

}  // namespace

ThreadPool::ThreadPool(unsigned threads) : next_(place(0, closed)) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  try {
    for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
  } catch (const std::exception&) {
    const std::string started = std::to_string(size());
    stop();
    throw Error(ErrorKind::device, "--threads", "the system gave " + started + " of " + std::to_string(threads) + " threads",
                "ask for fewer");
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  stopping_ = true;
  ++loop_;
  loop_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::for_ranges(std::uint32_t count, std::uint32_t grain, const Body& body) {
  PLIANT_EXPECT(count < closed);
  if (workers_.empty() || count <= grain) {
    for (std::uint32_t first = 0; first < count; first += std::min(grain, count - first))
      body(first, first + std::min(grain, count - first));
    return;
  }
  body_ = &body;
  count_ = count;
  grain_ = grain;
  done_ = 0;
  const std::uint32_t loop = loop_ + 1;
  next_ = place(loop, 0);
  loop_ = loop;
  loop_.notify_all();
  take_ranges();
  for (std::uint32_t done = done_; done != count; done = done_) done_.wait(done);
  next_ = place(loop, closed);
}

void ThreadPool::work() {
  std::uint32_t seen = 0;
  while (!stopping_) {
    take_ranges();
    loop_.wait(seen);
    seen = loop_;
  }
}

void ThreadPool::take_ranges() {
  std::uint64_t next = next_;
  while (true) {
    const std::uint32_t count = count_, first = item_of(next);
    if (first >= count) return;
    const std::uint32_t size = std::min<std::uint32_t>(grain_, count - first);
    if (!next_.compare_exchange_weak(next, next + size)) continue;
    (*body_)(first, first + size);
    if ((done_ += size) == count) done_.notify_one();
    next = next_;
  }
}

}  // namespace pliant
