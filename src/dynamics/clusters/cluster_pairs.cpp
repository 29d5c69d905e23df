#include "dynamics/clusters/cluster_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

constexpr std::uint64_t most_near = 1u << 31;  // entries of `near`, which are counted in 32 bits

// Weighs the error of one node a side against that of four. Measured: gives the least work for the same error.
double weight_of_one_node(double accuracy) { return accuracy > 3e-7 ? 0.05 : accuracy > 3e-8 ? 0.03 : 0.01; }

template <class T>
void flatten(const std::vector<std::vector<T>>& lists, std::vector<std::uint32_t>& begin, std::vector<T>& items) {
  begin = {0};
  for (const std::vector<T>& list : lists) {
    items.insert(items.end(), list.begin(), list.end());
    begin.push_back(static_cast<std::uint32_t>(items.size()));
  }
}

class Walk {
 public:
  Walk(const ClusterTree& tree, double accuracy, std::span<const Extent> shape)
      : clusters_(tree.clusters),
        shape_(shape),
        accuracy_(accuracy),
        weight_of_one_node_(weight_of_one_node(accuracy)),
        near_(tree.leaves.size()),
        far_(tree.clusters.size()) {
    PLIANT_EXPECT(accuracy > 0 && (shape.empty() || shape.size() == clusters_.size()));
    meet_itself(0);
  }

  ClusterPairs take() {
    ClusterPairs pairs;
    for (std::vector<std::uint32_t>& leaves : near_) std::ranges::sort(leaves);
    flatten(near_, pairs.near_begin, pairs.near);
    flatten(far_, pairs.far_begin, pairs.far);
    return pairs;
  }

 private:
  void meet_itself(std::uint32_t a) {
    const Cluster& cluster = clusters_[a];
    if (cluster.is_leaf()) {
      near_[cluster.first_leaf()].push_back(cluster.first_leaf());
      return;
    }
    meet_itself(cluster.first_child);
    meet_itself(cluster.first_child + 1);
    meet(cluster.first_child, cluster.first_child + 1);
  }

  void meet(std::uint32_t a, std::uint32_t b) {
    const Cluster &first = clusters_[a], &second = clusters_[b];
    if (const std::uint32_t nodes = nodes_between(a, b); nodes > 0) {
      if (saves_work(first, second, nodes)) {
        far_[a].push_back({b, nodes});
        far_[b].push_back({a, nodes});
      } else {
        meet_closely(first, second);
      }
    } else if (first.is_leaf() && second.is_leaf()) {
      meet_closely(first, second);
    } else if (second.is_leaf() || (!first.is_leaf() && first.rest.radius >= second.rest.radius)) {
      meet(first.first_child, b);
      meet(first.first_child + 1, b);
    } else {
      meet(a, second.first_child);
      meet(a, second.first_child + 1);
    }
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

  void meet_closely(const Cluster& a, const Cluster& b) {
    near_count_ += 2 * std::uint64_t{a.end_leaf() - a.first_leaf()} * (b.end_leaf() - b.first_leaf());
    if (near_count_ > most_near)
      throw Error(ErrorKind::input, "", "too many vertices are near each other for lists of clusters",
                  "weld them, or take a larger force_tolerance");
    for (std::uint32_t i = a.first_leaf(); i < a.end_leaf(); ++i)
      for (std::uint32_t j = b.first_leaf(); j < b.end_leaf(); ++j) {
        near_[i].push_back(j);
        near_[j].push_back(i);
      }
  }

  const std::vector<Cluster>& clusters_;
  std::span<const Extent> shape_;
  double accuracy_, weight_of_one_node_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<std::vector<FarCluster>> far_;
  std::uint64_t near_count_ = 0;
};

}  // namespace

ClusterPairs pair_clusters(const ClusterTree& tree, double accuracy, std::span<const Extent> shape) {
  return Walk(tree, accuracy, shape).take();
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
