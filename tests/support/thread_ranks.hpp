// Ranks that are threads of one process.
#pragma once
#include <algorithm>
#include <barrier>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "ranks/ranks.hpp"

namespace pliant::test {

/// What the threads have in common.
struct Gathering {
  explicit Gathering(std::size_t count) : arrays(count), said(count), arrived(static_cast<std::ptrdiff_t>(count)) {}
  std::vector<std::span<double>> arrays;  // of each rank, that it shares
  std::vector<std::uint64_t> said;        // by each rank
  std::span<const std::byte> of_first;
  std::barrier<> arrived;
};

class ThreadRanks : public Ranks {
 public:
  ThreadRanks(Gathering& all, std::size_t number) : all_(all), number_(number) {}
  std::size_t number() const override { return number_; }
  std::size_t count() const override { return all_.arrays.size(); }
  std::size_t number_here() const override { return number_; }
  std::size_t count_here() const override { return count(); }
  void take_from_first(std::span<std::byte> bytes) override {
    if (number_ == 0) all_.of_first = bytes;
    all_.arrived.arrive_and_wait();
    if (number_ != 0) std::ranges::copy(all_.of_first, bytes.begin());
    all_.arrived.arrive_and_wait();
  }
  std::vector<std::uint64_t> hear_all(std::uint64_t mine) override {
    all_.said[number_] = mine;
    all_.arrived.arrive_and_wait();
    std::vector<std::uint64_t> said = all_.said;
    all_.arrived.arrive_and_wait();
    return said;
  }
  void begin_sharing(std::span<double> array, std::span<const NumberRange> ranges) override {
    on_their_way_.push_back({array, {ranges.begin(), ranges.end()}});
    ++sharings_;
  }
  void go_on() override {}
  void end_sharing() override {
    const Sharing oldest = on_their_way_.front();
    on_their_way_.pop_front();
    all_.arrays[number_] = oldest.array;
    all_.arrived.arrive_and_wait();
    for (std::size_t rank = 0; rank < count(); ++rank)
      if (rank != number_)
        std::ranges::copy(all_.arrays[rank].subspan(oldest.ranges[rank].first, oldest.ranges[rank].count),
                          oldest.array.subspan(oldest.ranges[rank].first).begin());
    all_.arrived.arrive_and_wait();
  }
  void agree_to_end() override { have_agreed_ = true; }
  [[nodiscard]] bool have_agreed_to_end() const { return have_agreed_; }
  [[nodiscard]] std::uint64_t sharings() const { return sharings_; }

 private:
  struct Sharing {
    std::span<double> array;
    std::vector<NumberRange> ranges;
  };

  Gathering& all_;
  std::size_t number_;
  std::deque<Sharing> on_their_way_;
  std::uint64_t sharings_ = 0;
  bool have_agreed_ = false;
};

/// Does this on so many ranks at once.
inline void on_ranks(std::size_t count, const std::function<void(ThreadRanks&)>& work) {
  Gathering all(count);
  std::vector<std::jthread> threads;
  for (std::size_t rank = 0; rank < count; ++rank)
    threads.emplace_back([&all, &work, rank] {
      ThreadRanks own(all, rank);
      work(own);
    });
}

}  // namespace pliant::test
