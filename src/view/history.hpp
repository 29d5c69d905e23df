// Keeps the latest states of a simulation to go back to, as many as a bounded memory holds.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

namespace pliant::view {

struct Snapshot {
  std::uint64_t step = 0;
  std::string saved;  // what Simulation::save returned

  [[nodiscard]] std::size_t bytes() const;
};

class History {
 public:
  /// Holds the latest snapshots that fit into `most_bytes` together. It always holds the latest one.
  explicit History(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Adds a snapshot. It replaces snapshots of the same step and of later ones.
  void record(Snapshot snapshot);
  /// Returns the latest snapshot from before `step`, or null. It is valid until the next record() or clear().
  [[nodiscard]] const Snapshot* before(std::uint64_t step) const;
  void clear();
  [[nodiscard]] std::size_t size() const { return snapshots_.size(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t most_bytes() const { return most_bytes_; }

 private:
  std::size_t most_bytes_, bytes_ = 0;
  std::deque<Snapshot> snapshots_;  // by ascending step
};

}  // namespace pliant::view
