// The latest states of a simulation, as many as a bounded memory holds, to go back to.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

namespace pliant::view {

struct Snapshot {
  std::uint64_t step = 0;
  std::string saved;  // by Simulation::save

  [[nodiscard]] std::size_t bytes() const;
};

class History {
 public:
  /// Holds the latest snapshots that fit into `most_bytes` together, but always one.
  explicit History(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Snapshots of this step and of later ones are replaced by it.
  void record(Snapshot snapshot);
  /// The latest one from before a step; null if there is none. Valid until the next record() or clear().
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
