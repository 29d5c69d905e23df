#include "dynamics/clusters/cluster_pairs.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/thread_pool.hpp"

namespace pliant {
namespace {

constexpr std::size_t enough_meetings = 200;            // to be shared among threads
constexpr std::uint64_t entries_between_counts = 1000;  // of a thread: it counts so often that the limit is overrun by little

// Weighs the error of one node a side against that of four. Measured: gives the least work for the same error.
double weight_of_one_node(double accuracy) { return accuracy > 3e-7 ? 0.05 : accuracy > 3e-8 ? 0.03 : 0.01; }

// Two clusters, all of whose vertices are to see each other. They are the same one if its vertices are to see each other.
struct Meeting {
  std::uint32_t a, b;
};

// What becomes of a meeting: others in its place, or else a pair.
struct Outcome {
  std::array<Meeting, 3> meetings{};
  std::uint32_t meeting_count = 0;
  std::uint32_t nodes = 0;  // without meetings: of a pair that is far from each other. 0: all leaves see each other's vertices
};

struct FarPair {
  Meeting clusters;
  std::uint32_t nodes;
};

struct Found {
  std::vector<FarPair> far;
  std::vector<Meeting> near;
  std::uint64_t entries = 0;  // of both lists that have not been counted yet
};

class Walk {
 public:
  Walk(const ClusterTree& tree, double accuracy, std::span<const Extent> shape, std::uint64_t most_entries)
      : clusters_(tree.clusters),
        shape_(shape),
        accuracy_(accuracy),
        weight_of_one_node_(weight_of_one_node(accuracy)),
        most_entries_(most_entries) {
    PLIANT_EXPECT(accuracy > 0 && (shape.empty() || shape.size() == clusters_.size()));
  }

  // Returns what has been found, in an order that does not depend on threads. Throws as pair_clusters() does.
  [[nodiscard]] std::vector<Found> find(ThreadPool& pool) {
    const std::vector<Meeting> meetings = first_meetings();
    std::vector<Found> found(meetings.size());
    pool.for_ranges(static_cast<std::uint32_t>(meetings.size()), 1, [&](std::uint32_t first, std::uint32_t end) {
      try {
        for (std::uint32_t m = first; m < end; ++m) {
          meet(meetings[m], found[m]);
          count(found[m]);
        }
      } catch (const std::bad_alloc&) {  // a pool's loop must not throw
        lacks_memory_ = true;
      }
    });
    if (lacks_memory_) throw std::bad_alloc();
    if (entries_ > most_entries_)
      throw Error(ErrorKind::input, "", "too many vertices are near each other for lists of clusters",
                  "weld them, or take a larger force_tolerance");
    return found;
  }

 private:
  // Returns meetings that cover all pairs of vertices.
  [[nodiscard]] std::vector<Meeting> first_meetings() const {
    std::vector<Meeting> meetings = {{0, 0}};
    for (std::size_t before = 0; before != meetings.size() && meetings.size() < enough_meetings;) {
      before = meetings.size();
      std::vector<Meeting> next;
      for (const Meeting& meeting : meetings) {
        const Outcome outcome = outcome_of(meeting);
        next.insert(next.end(), outcome.meetings.begin(), outcome.meetings.begin() + outcome.meeting_count);
        if (outcome.meeting_count == 0) next.push_back(meeting);
      }
      meetings = std::move(next);
    }
    return meetings;
  }

  void meet(const Meeting& meeting, Found& found) {
    if (entries_ > most_entries_ || lacks_memory_) return;
    const Outcome outcome = outcome_of(meeting);
    for (std::uint32_t k = 0; k < outcome.meeting_count; ++k) meet(outcome.meetings[k], found);
    if (outcome.meeting_count > 0) return;
    if (outcome.nodes > 0) {
      found.entries += 2;
      found.far.push_back({meeting, outcome.nodes});
    } else {
      found.entries += (meeting.a == meeting.b ? 1 : 2) * leaf_count(meeting.a) * leaf_count(meeting.b);
      found.near.push_back(meeting);
    }
    if (found.entries >= entries_between_counts) count(found);
  }

  void count(Found& found) { entries_ += std::exchange(found.entries, 0); }

  [[nodiscard]] Outcome outcome_of(const Meeting& meeting) const {
    const auto [a, b] = meeting;
    const Cluster &first = clusters_[a], &second = clusters_[b];
    const std::uint32_t child = first.first_child;
    if (a == b && first.is_leaf()) return {};
    if (a == b) return {{{{child, child}, {child + 1, child + 1}, {child, child + 1}}}, 3};
    if (const std::uint32_t nodes = nodes_between(a, b); nodes > 0) return {{}, 0, saves_work(first, second, nodes) ? nodes : 0};
    if (first.is_leaf() && second.is_leaf()) return {};
    if (second.is_leaf() || (!first.is_leaf() && first.rest.radius >= second.rest.radius))
      return {{{{child, b}, {child + 1, b}}}, 2};
    return {{{{a, second.first_child}, {a, second.first_child + 1}}}, 2};
  }

  [[nodiscard]] std::uint64_t leaf_count(std::uint32_t cluster) const {
    return clusters_[cluster].end_leaf() - clusters_[cluster].first_leaf();
  }

  // Returns the product of both spreads over the distance squared, or nothing if they reach each other.
  static std::optional<double> spread_between(const Extent& a, const Extent& b) {
    const glm::dvec3 way = a.centre - b.centre;
    const double squared = glm::dot(way, way), radii = a.radius + b.radius;
    if (squared == 0 || radii * radii > squared) return {};
    return a.spread_squared / squared * (b.spread_squared / squared);
  }

  // Returns how many nodes a side are exact enough, or 0 if none are.
  [[nodiscard]] std::uint32_t nodes_between(std::uint32_t a, std::uint32_t b) const {
    std::optional<double> spread = spread_between(clusters_[a].rest, clusters_[b].rest);
    if (spread && !shape_.empty()) {
      const std::optional<double> in_shape = spread_between(shape_[a], shape_[b]);
      spread = in_shape ? std::optional(std::max(*spread, *in_shape)) : std::nullopt;
    }
    if (!spread) return 0;
    const double share = static_cast<double>(std::max(clusters_[a].size(), clusters_[b].size())) / clusters_[0].size();
    if (weight_of_one_node_ * share * *spread <= accuracy_) return 1;
    return share * *spread * *spread <= accuracy_ ? 4 : 0;
  }

  static bool saves_work(const Cluster& a, const Cluster& b, std::uint32_t nodes) {
    return std::uint64_t{a.size()} * b.size() > nodes * (std::uint64_t{a.size()} + b.size() + nodes);
  }

  const std::vector<Cluster>& clusters_;
  std::span<const Extent> shape_;
  double accuracy_, weight_of_one_node_;
  std::uint64_t most_entries_;
  std::atomic<std::uint64_t> entries_ = 0;  // of both lists that have been counted
  std::atomic<bool> lacks_memory_ = false;
};

// Calls `add` with two leaves for each pair of leaves that see each other's vertices, once for each side.
template <class Add>
void for_near_leaves(const ClusterTree& tree, const std::vector<Found>& found, const Add& add) {
  for (const Found& part : found)
    for (const auto& [a, b] : part.near) {
      const Cluster &first = tree.clusters[a], &second = tree.clusters[b];
      for (std::uint32_t i = first.first_leaf(); i < first.end_leaf(); ++i)
        for (std::uint32_t j = second.first_leaf(); j < second.end_leaf(); ++j) {
          add(i, j);
          if (a != b) add(j, i);
        }
    }
}

template <class Add>
void for_far_clusters(const std::vector<Found>& found, const Add& add) {
  for (const Found& part : found)
    for (const auto& [clusters, nodes] : part.far) {
      add(clusters.a, FarCluster{clusters.b, nodes});
      add(clusters.b, FarCluster{clusters.a, nodes});
    }
}

// Puts what `for_each` finds into one list, by owners. Fills `begin` with where each owner's part begins.
template <class Item, class ForEach>
std::vector<Item> listed_by_owner(std::size_t owners, std::vector<std::uint32_t>& begin, const ForEach& for_each) {
  begin.assign(owners + 1, 0);
  for_each([&](std::uint32_t owner, const Item&) { ++begin[owner + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Item> items(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for_each([&](std::uint32_t owner, const Item& item) { items[next[owner]++] = item; });
  return items;
}

}  // namespace

ClusterPairs pair_clusters(ThreadPool& pool, const ClusterTree& tree, double accuracy, std::span<const Extent> shape,
                           std::uint64_t most_entries) {
  const std::vector<Found> found = Walk(tree, accuracy, shape, most_entries).find(pool);
  ClusterPairs pairs;
  pairs.near = listed_by_owner<std::uint32_t>(tree.leaves.size(), pairs.near_begin,
                                              [&](const auto& add) { for_near_leaves(tree, found, add); });
  pairs.far =
      listed_by_owner<FarCluster>(tree.clusters.size(), pairs.far_begin, [&](const auto& add) { for_far_clusters(found, add); });
  for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf)
    std::sort(pairs.near.begin() + pairs.near_begin[leaf], pairs.near.begin() + pairs.near_begin[leaf + 1]);
  return pairs;
}

SpringCounts count_springs(const ClusterTree& tree, const ClusterPairs& pairs) {
  SpringCounts counts;
  for (std::uint32_t leaf = 0; leaf < tree.leaves.size(); ++leaf) {
    const std::uint64_t own = tree.clusters[tree.leaves[leaf]].size();
    for (std::uint32_t k = pairs.near_begin[leaf]; k < pairs.near_begin[leaf + 1]; ++k) {
      if (pairs.near[k] == leaf) counts.near += own * (own - 1) / 2;
      if (pairs.near[k] > leaf) counts.near += own * tree.clusters[tree.leaves[pairs.near[k]]].size();
    }
  }
  for (std::uint32_t c = 0; c < tree.clusters.size(); ++c)
    for (std::uint32_t k = pairs.far_begin[c]; k < pairs.far_begin[c + 1]; ++k) {
      const FarCluster& far = pairs.far[k];
      counts.far += std::uint64_t{tree.clusters[c].size()} * far.nodes;
      if (far.cluster > c) counts.between_nodes += std::uint64_t{far.nodes} * far.nodes;
    }
  return counts;
}

double accuracy_of(double tolerance) { return 1e-7 * std::pow(tolerance / 1e-3, 1.75); }

}  // namespace pliant
