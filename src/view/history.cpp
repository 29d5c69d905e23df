#include "view/history.hpp"

#include <algorithm>
#include <utility>

namespace pliant::view {

std::size_t Snapshot::bytes() const { return sizeof(*this) + saved.size(); }

void History::record(Snapshot snapshot) {
  while (!snapshots_.empty() && snapshots_.back().step >= snapshot.step) {
    bytes_ -= snapshots_.back().bytes();
    snapshots_.pop_back();
  }
  bytes_ += snapshot.bytes();
  snapshots_.push_back(std::move(snapshot));
  while (bytes_ > most_bytes_ && snapshots_.size() > 1) {
    bytes_ -= snapshots_.front().bytes();
    snapshots_.pop_front();
  }
}

const Snapshot* History::before(std::uint64_t step) const {
  const auto next = std::ranges::lower_bound(snapshots_, step, {}, &Snapshot::step);
  return next == snapshots_.begin() ? nullptr : &*std::prev(next);
}

void History::clear() {
  snapshots_.clear();
  bytes_ = 0;
}

}  // namespace pliant::view
