#include "core/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <mutex>
#include <thread>
#include <vector>

namespace pliant {
namespace {

TEST_CASE("every item of a loop is visited exactly once, on any number of threads") {
  for (const unsigned threads : {1u, 2u, 7u}) {
    ThreadPool pool(threads);
    CHECK(pool.size() == threads);
    for (const std::uint32_t count : {0u, 1u, 15u, 16u, 17u, 1000u, 65537u}) {
      std::vector<int> visits(count, 0);
      pool.for_ranges(count, 16, [&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) ++visits[i];
      });
      CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST_CASE("thousands of short loops follow each other, each with the body and items of its own") {
  ThreadPool pool(4);
  std::uint64_t wrong = 0;
  for (std::uint32_t loop = 1; loop <= 2000; ++loop) {
    const std::uint32_t count = 2 + loop % 61;
    std::vector<std::uint32_t> seen(count, 0);
    pool.for_ranges(count, 1, [&seen, loop](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t i = first; i < end; ++i) seen[i] += loop;
    });
    wrong += static_cast<std::uint64_t>(std::count_if(seen.begin(), seen.end(), [loop](std::uint32_t n) { return n != loop; }));
  }
  CHECK(wrong == 0);
}

TEST_CASE("a thread takes part in a loop once at most, and its ranges have as many items as asked for or fewer") {
  constexpr std::uint32_t grain = 16;
  for (const unsigned threads : {1u, 2u, 7u}) {
    ThreadPool pool(threads);
    for (const std::uint32_t count : {0u, 1u, grain, grain + 1, 1000u})
      for (int loop = 0; loop < 20; ++loop) {
        CAPTURE(threads, count);
        std::vector<int> visits(count, 0);
        std::mutex mutex;
        std::vector<std::thread::id> takers;
        std::vector<std::uint32_t> lengths;
        pool.share(count, grain, [&](ThreadPool::Ranges& ranges) {
          std::vector<std::uint32_t> own;
          for (std::uint32_t first = 0, end = 0; ranges.take(first, end);) {
            own.push_back(end - first);
            for (; first < end; ++first) ++visits[first];
          }
          const std::lock_guard lock(mutex);
          takers.push_back(std::this_thread::get_id());
          lengths.insert(lengths.end(), own.begin(), own.end());
        });
        CHECK(takers.size() <= threads);
        std::ranges::sort(takers);
        CHECK(std::ranges::adjacent_find(takers) == takers.end());
        CHECK(lengths.size() == (count + grain - 1) / grain);
        CHECK(std::ranges::all_of(lengths, [](std::uint32_t length) { return length >= 1 && length <= grain; }));
        CHECK(std::ranges::all_of(visits, [](int n) { return n == 1; }));
      }
  }
}

TEST_CASE("what a part does after its last range is done when the loop ends") {
  ThreadPool pool(4);
  for (std::uint32_t loop = 0; loop < 500; ++loop) {
    std::atomic<std::uint32_t> added = 0;
    pool.share(100, 1, [&](ThreadPool::Ranges& ranges) {
      std::uint32_t sum = 0;
      for (std::uint32_t first = 0, end = 0; ranges.take(first, end);) sum += end - first;
      for (int k = 0; k < 100; ++k) std::this_thread::yield();  // takes its time
      added += sum;
    });
    CHECK(added == 100);
  }
}

TEST_CASE("pools stand beside each other, and wake up after others have worked for long") {
  ThreadPool first(2), second(2), many(64);
  std::atomic<std::uint64_t> items = 0;
  for (int round = 0; round < 3; ++round)
    for (ThreadPool* pool : {&first, &second, &many})
      pool->for_ranges(1000, 1, [&](std::uint32_t begin, std::uint32_t end) {
        for (int k = 0; k < 1000; ++k) items += end - begin;
      });
  CHECK(items == 9'000'000);
}

}  // namespace
}  // namespace pliant
