// Between loops `next_` says `closed`, so a late thread never takes an item by the count of another loop.
#include "core/thread_pool.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <string>
#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#endif

#include "core/error.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t closed = 0xffffffffu;

constexpr std::uint64_t place(std::uint32_t loop, std::uint32_t item) { return (static_cast<std::uint64_t>(loop) << 32) | item; }
constexpr std::uint32_t item_of(std::uint64_t place) { return static_cast<std::uint32_t>(place); }

constexpr std::chrono::microseconds longest_spin{50};

// Tells the processor that this is a waiting loop.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

#ifdef __linux__
// Returns the processors that this thread may run on. The one that it is on comes last.
std::vector<int> allowed_processors() {
  cpu_set_t allowed;
  std::vector<int> processors;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return processors;
  for (int k = 0; k < CPU_SETSIZE; ++k)
    if (CPU_ISSET(k, &allowed)) processors.push_back(k);
  std::stable_partition(processors.begin(), processors.end(), [here = sched_getcpu()](int k) { return k != here; });
  return processors;
}

void keep_on(std::thread& thread, int processor) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(processor, &only);
  pthread_setaffinity_np(thread.native_handle(), sizeof(only), &only);  // if it fails, loops are slower but right
}
#else
std::vector<int> allowed_processors() { return std::vector<int>(std::thread::hardware_concurrency()); }
void keep_on(std::thread&, int) {}
#endif

}  // namespace

unsigned thread_count(unsigned asked) {
  if (asked != 0) return asked;
  const auto allowed = static_cast<unsigned>(allowed_processors().size());
  return std::max(1u, allowed != 0 ? allowed : std::thread::hardware_concurrency());
}

ThreadPool::ThreadPool(unsigned threads) : next_(place(0, closed)) {
  threads = thread_count(threads);
  const std::vector<int> processors = allowed_processors();
  own_processors_ = threads <= processors.size();
  const bool pinned = threads == processors.size();  // smaller pools would all crowd the same processors
  try {
    for (unsigned k = 1; k < threads; ++k) {
      workers_.emplace_back([this] { work(); });
      if (pinned) keep_on(workers_.back(), processors[k - 1]);
    }
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

void ThreadPool::share(std::uint32_t count, std::uint32_t grain, const Part& part) {
  PLIANT_EXPECT(count < closed);
  if (workers_.empty() || count <= grain) {
    Ranges all(count, grain);
    part(all);
    return;
  }
  part_ = &part;
  count_ = count;
  grain_ = grain;
  done_ = 0;
  const std::uint32_t loop = loop_ + 1;
  next_ = place(loop, 0);
  loop_ = loop;
  loop_.notify_all();
  take_part();
  for (std::uint32_t done = done_; done != count; done = done_) await_change(done_, done);
  next_ = place(loop, closed);
}

void ThreadPool::for_ranges(std::uint32_t count, std::uint32_t grain, const Body& body) {
  share(count, grain, [&](Ranges& ranges) {
    for (std::uint32_t first = 0, end = 0; ranges.take(first, end);) body(first, end);
  });
}

void ThreadPool::work() {
  std::uint32_t seen = 0;
  while (!stopping_) {
    take_part();
    await_change(loop_, seen);
    seen = loop_;
  }
}

void ThreadPool::await_change(const std::atomic<std::uint32_t>& value, std::uint32_t from) const {
  if (own_processors_) {
    const auto end = std::chrono::steady_clock::now() + longest_spin;
    do {
      for (int k = 0; k < 16; ++k) {
        if (value != from) return;
        pause();
      }
    } while (std::chrono::steady_clock::now() < end);
  }
  value.wait(from);
}

// Who has taken items may rely on the loop, because it does not end before they are done.
void ThreadPool::take_part() {
  Ranges ranges(*this);
  if (!ranges.take_more()) return;
  (*part_)(ranges);
  if ((done_ += ranges.taken_) == ranges.count_) done_.notify_one();
}

bool ThreadPool::Ranges::take_more() {
  if (pool_ == nullptr) return false;
  std::uint64_t next = pool_->next_;
  while (true) {
    const std::uint32_t count = pool_->count_, first = item_of(next);
    if (first >= count) return false;
    grain_ = pool_->grain_;
    const std::uint32_t size = std::min(grain_, count - first);
    if (!pool_->next_.compare_exchange_weak(next, next + size)) continue;
    first_ = first;
    end_ = first + size;
    taken_ += size;
    count_ = count;
    return true;
  }
}

}  // namespace pliant
