// The trees of all clustered bodies stand one after another in the same arrays.
#include "dynamics/clusters/cluster_forces.hpp"

#include <algorithm>

#include "core/expect.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_tree.hpp"
#include "physics/forces/clusters.glsl"

namespace pliant {
namespace {

static_assert(physics::bank_row == physics::group_size + 1 && physics::places_of_tile == physics::group_size);

struct Tables {
  std::vector<std::uint32_t> tree_vertices;
  std::vector<physics::SpringCluster> clusters;
  std::vector<glm::uvec4> leaves;
  std::vector<std::uint32_t> near_leaves, above_clusters;
  std::vector<glm::uvec2> far_clusters;
  std::uint32_t pull_row_count = 0;
};

void store(double* to, const glm::dvec3& from) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

physics::SpringCluster table_row(const Cluster& cluster) {
  physics::SpringCluster row{};
  store(row.centre, cluster.centre);
  for (std::size_t n = 0; n < 4; ++n) {
    store(row.offset + 3 * n, cluster.nodes[n + 1].offset);
    store(row.gradient + 3 * n, cluster.nodes[n + 1].gradient);
  }
  row.vertex_count = cluster.size();
  return row;
}

class BodyTables {
 public:
  BodyTables(Tables& tables, const Model& model, std::uint32_t body_index, double accuracy)
      : tables_(tables),
        body_(model.bodies[body_index]),
        body_index_(body_index),
        first_cluster_(static_cast<std::uint32_t>(tables.clusters.size())),
        first_leaf_(static_cast<std::uint32_t>(tables.leaves.size())) {
    std::vector<glm::dvec3> rest;
    for (std::uint32_t i = 0; i < body_.vertex_count; ++i) rest.push_back(model.rest_position(body_.first_vertex + i));
    tree_ = make_cluster_tree(rest);
    pairs_ = pair_clusters(tree_, accuracy);
    add_leaves();
    add_clusters();
    set_places_of_pulls();
  }

  [[nodiscard]] std::uint64_t spring_count() const { return count_springs(tree_, pairs_).all(); }

 private:
  void add_leaves() {
    for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      const std::uint32_t of_leaf = tree_.leaves[leaf];
      const Cluster& cluster = tree_.clusters[of_leaf];
      tables_.leaves.emplace_back(body_index_, first_cluster_ + of_leaf, tables_.near_leaves.size(),
                                  tables_.above_clusters.size());
      for (std::uint32_t k = 0; k < leaf_size; ++k)  // behind the end of the last leaf its last vertex comes again
        tables_.tree_vertices.push_back(body_.first_vertex + tree_.order[std::min(cluster.first + k, cluster.end - 1)]);
      for (std::uint32_t k = pairs_.near_begin[leaf]; k < pairs_.near_begin[leaf + 1]; ++k)
        tables_.near_leaves.push_back(first_leaf_ + pairs_.near[k]);
      for (std::uint32_t c = of_leaf;; c = tree_.clusters[c].parent) {
        if (pairs_.far_begin[c] < pairs_.far_begin[c + 1]) tables_.above_clusters.push_back(first_cluster_ + c);
        if (c == 0) break;
      }
    }
  }

  void add_clusters() {
    for (std::uint32_t c = 0; c < tree_.clusters.size(); ++c) {
      const Cluster& cluster = tree_.clusters[c];
      physics::SpringCluster row = table_row(cluster);
      row.body_index = body_index_;
      row.first_leaf = first_leaf_ + cluster.first_leaf();
      row.end_leaf = first_leaf_ + cluster.end_leaf();
      row.first_far = static_cast<std::uint32_t>(tables_.far_clusters.size());
      row.first_pull = tables_.pull_row_count;
      tables_.pull_row_count += (list_far(c, 1) + 3) / 4;
      row.first_far_four = static_cast<std::uint32_t>(tables_.far_clusters.size());
      row.first_pull_four = tables_.pull_row_count;
      tables_.pull_row_count += list_far(c, 4);
      row.end_far = static_cast<std::uint32_t>(tables_.far_clusters.size());
      row.end_pull = tables_.pull_row_count;
      tables_.clusters.push_back(row);
    }
  }

  // Lists the clusters of which this one sees so many nodes. Returns how many leaves they have.
  std::uint32_t list_far(std::uint32_t c, std::uint32_t nodes) {
    std::uint32_t leaves = 0;
    for (std::uint32_t k = pairs_.far_begin[c]; k < pairs_.far_begin[c + 1]; ++k) {
      if (pairs_.far[k].nodes != nodes) continue;
      tables_.far_clusters.emplace_back(first_cluster_ + pairs_.far[k].cluster, 0);
      leaves += leaf_count_of(first_cluster_ + pairs_.far[k].cluster);
    }
    return leaves;
  }

  // What leaves of far clusters pull a cluster's nodes with stands in the order of its list. Those clusters have to know where.
  void set_places_of_pulls() {
    for (auto c = first_cluster_; c < tables_.clusters.size(); ++c) {
      const physics::SpringCluster& row = tables_.clusters[c];
      std::uint32_t place = physics::pull_row_size * row.first_pull;
      for (std::uint32_t k = row.first_far; k < row.end_far; ++k) {
        if (k == row.first_far_four) place = physics::pull_row_size * row.first_pull_four;
        const std::uint32_t far = tables_.far_clusters[k].x;
        entry_of(far, c).y = place;
        place += leaf_count_of(far) * physics::leaf_of_pull(k < row.first_far_four ? 1 : 4);
      }
    }
  }

  // Returns where a cluster lists another one.
  glm::uvec2& entry_of(std::uint32_t listing, std::uint32_t listed) {
    const physics::SpringCluster& row = tables_.clusters[listing];
    return *std::find_if(tables_.far_clusters.begin() + row.first_far, tables_.far_clusters.begin() + row.end_far,
                         [&](const glm::uvec2& entry) { return entry.x == listed; });
  }

  std::uint32_t leaf_count_of(std::uint32_t c) const {
    const Cluster& cluster = tree_.clusters[c - first_cluster_];
    return cluster.end_leaf() - cluster.first_leaf();
  }

  Tables& tables_;
  const ModelBody& body_;
  std::uint32_t body_index_, first_cluster_, first_leaf_;
  ClusterTree tree_;
  ClusterPairs pairs_;
};

}  // namespace

ClusterForces::ClusterForces(DeviceBodies& bodies, const Model& model, std::span<const std::optional<double>> accuracies)
    : bodies_(bodies), springs_of_bodies_(model.bodies.size()) {
  PLIANT_EXPECT(accuracies.size() == model.bodies.size());
  Tables tables;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b)
    if (accuracies[b]) springs_of_bodies_[b] = BodyTables(tables, model, b, *accuracies[b]).spring_count();
  const auto leaf_count = static_cast<std::uint32_t>(tables.leaves.size());
  cluster_count_ = static_cast<std::uint32_t>(tables.clusters.size());
  leaf_count_ = leaf_count;
  tables.leaves.emplace_back(0, 0, tables.near_leaves.size(), tables.above_clusters.size());
  const std::uint32_t place_count = leaf_size * leaf_count;
  Arrays& arrays = bodies.arrays;
  arrays.set_parameter("place_count", place_count);
  arrays.set_parameter("leaf_count", leaf_count);
  arrays.make("tree_vertex", tables.tree_vertices);
  arrays.make("spring_cluster", tables.clusters);
  arrays.make("spring_leaf", tables.leaves);
  arrays.make("near_leaf", tables.near_leaves);
  arrays.make("above_cluster", tables.above_clusters);
  arrays.make("far_cluster", tables.far_clusters);
  arrays.make_reals("spring_point", std::size_t{8} * (place_count + physics::nodes_of_cluster * cluster_count_));
  arrays.make<double>("leaf_moment", std::size_t{physics::moments_size} * leaf_count);
  arrays.make_reals("leaf_pull", std::size_t{3} * place_count);
  arrays.make_reals("node_pull", std::size_t{physics::pull_row_size} * tables.pull_row_count);
  arrays.make<double>("cluster_pull", std::size_t{physics::moments_size} * cluster_count_);
  arrays.make<double>("spring_sum", std::size_t{3} * bodies.vertex_count);
}

std::vector<Pass> ClusterForces::passes(std::uint32_t slot, bool only_stale) const {
  const Arrays& arrays = bodies_.arrays;
  const auto pass = [&](std::string_view name, std::uint32_t items, Parameters parameters = {}) {
    parameters.emplace_back("only_stale", only_stale ? 1u : 0u);
    return make_pass(arrays, name, arrays.device().group_kernel(name, physics::group_size), parameters, items);
  };
  const std::uint32_t tile_count = (leaf_count_ + physics::leaves_of_tile - 1) / physics::leaves_of_tile;
  return {pass("sum_leaf_moments", tile_count, {{"slot", slot}}), pass("place_nodes", cluster_count_),
          pass("sum_leaf_springs", leaf_count_), pass("sum_node_pulls", cluster_count_), pass("share_pulls", tile_count)};
}

}  // namespace pliant
