// Springs that several ranks sum, each of them for a part of the vertices.
#pragma once
#include <memory>
#include <vector>

#include "device/pass.hpp"
#include "model/model.hpp"
#include "ranks/ranks.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Sets `spring_sum` on all ranks, for all soft bodies whose springs are not summed by clusters. Each rank sums the springs of
/// some vertices and sends the sums to the others. The bits are those of one rank alone. Sums of large bodies travel in portions,
/// while a GPU works on the next.
class SharedSums {
 public:
  /// Makes the array of its shares. `bodies` and `ranks` must outlive this, and `spring_sum` has to be there for all vertices.
  /// All ranks have devices of one kind.
  SharedSums(DeviceBodies& bodies, const Model& model, const std::vector<bool>& are_clustered, Ranks& ranks);

  /// Returns passes that set the sums at the placements in a slot. With `only_stale` they do so only for bodies whose kept spring
  /// forces do not hold.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t slot, bool only_stale) const;

 private:
  class Exchange;
  struct Group {  // this rank's shares of one variant in one portion
    std::size_t portion, variant;
    std::uint32_t first_share, share_count;
  };

  DeviceBodies* bodies_;
  std::vector<Group> groups_;
  std::shared_ptr<Exchange> exchange_;
};

}  // namespace pliant
