// The trees of all clustered bodies stand one after another in the same arrays.
#include "dynamics/clusters/cluster_forces.hpp"

#include <algorithm>

#include "core/expect.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_tree.hpp"
#include "physics/forces/clusters.glsl"

namespace pliant {
namespace {

constexpr std::uint32_t threads_of_group = 64;  // which kernels share out a leaf's springs to

struct Tables {
  std::vector<std::uint32_t> tree_vertices;
  std::vector<physics::SpringCluster> clusters;
  std::vector<glm::uvec4> leaves;
  std::vector<std::uint32_t> near_begin{0}, near_leaves;
  std::vector<std::uint32_t> far_nodes;  // before all places are counted: cluster times nodes_of_cluster + node
  std::vector<glm::uvec4> far_clusters;
  std::uint32_t node_pull_count = 0;
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
    add_partners();
  }

  [[nodiscard]] std::uint64_t spring_count() const { return count_springs(tree_, pairs_).all(); }

 private:
  void add_leaves() {
    for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      const Cluster& cluster = tree_.clusters[tree_.leaves[leaf]];
      tables_.leaves.emplace_back(body_index_, first_cluster_ + tree_.leaves[leaf], 0, cluster.size());
      for (std::uint32_t k = 0; k < leaf_size; ++k)  // behind the end of the last leaf its last vertex comes again
        tables_.tree_vertices.push_back(body_.first_vertex + tree_.order[std::min(cluster.first + k, cluster.end - 1)]);
      for (std::uint32_t k = pairs_.near_begin[leaf]; k < pairs_.near_begin[leaf + 1]; ++k)
        tables_.near_leaves.push_back(first_leaf_ + pairs_.near[k]);
      tables_.near_begin.push_back(static_cast<std::uint32_t>(tables_.near_leaves.size()));
    }
  }

  void add_clusters() {
    for (std::uint32_t c = 0; c < tree_.clusters.size(); ++c) {
      const Cluster& cluster = tree_.clusters[c];
      physics::SpringCluster row = table_row(cluster);
      row.body_index = body_index_;
      row.parent = c == 0 ? physics::no_cluster : first_cluster_ + cluster.parent;
      row.first_leaf = first_leaf_ + cluster.first_leaf();
      row.end_leaf = first_leaf_ + cluster.end_leaf();
      row.first_far = static_cast<std::uint32_t>(tables_.far_nodes.size());
      row.first_node_pull = tables_.node_pull_count;
      for (std::uint32_t k = pairs_.far_begin[c]; k < pairs_.far_begin[c + 1]; ++k) {
        const FarCluster& far = pairs_.far[k];
        for (std::uint32_t n = 0; n < far.nodes; ++n)
          tables_.far_nodes.push_back((first_cluster_ + far.cluster) * physics::nodes_of_cluster +
                                      physics::first_node(far.nodes) + n);
      }
      row.end_far = static_cast<std::uint32_t>(tables_.far_nodes.size());
      tables_.node_pull_count += (row.end_far - row.first_far) * (row.end_leaf - row.first_leaf);
      tables_.clusters.push_back(row);
    }
  }

  // A partner's leaves keep what they pull a cluster's nodes with. Where, follows from the partner's list.
  void add_partners() {
    for (std::uint32_t c = 0; c < tree_.clusters.size(); ++c) {
      physics::SpringCluster& row = tables_.clusters[first_cluster_ + c];
      row.first_partner = static_cast<std::uint32_t>(tables_.far_clusters.size());
      for (std::uint32_t k = pairs_.far_begin[c]; k < pairs_.far_begin[c + 1]; ++k) {
        const FarCluster& far = pairs_.far[k];
        tables_.far_clusters.emplace_back(first_cluster_ + far.cluster, far.nodes, first_pull_of(far.cluster, c),
                                          leaf_count_of(far.cluster));
      }
      row.end_partner = static_cast<std::uint32_t>(tables_.far_clusters.size());
    }
  }

  std::uint32_t leaf_count_of(std::uint32_t c) const { return tree_.clusters[c].end_leaf() - tree_.clusters[c].first_leaf(); }

  // Where the leaves of `seeing` keep what they pull the nodes of `seen` with.
  std::uint32_t first_pull_of(std::uint32_t seeing, std::uint32_t seen) const {
    const physics::SpringCluster& row = tables_.clusters[first_cluster_ + seeing];
    std::uint32_t nodes = 0;
    for (std::uint32_t k = pairs_.far_begin[seeing]; pairs_.far[k].cluster != seen; ++k) nodes += pairs_.far[k].nodes;
    return row.first_node_pull + nodes * (row.end_leaf - row.first_leaf);
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
  leaf_count_ = static_cast<std::uint32_t>(tables.leaves.size());
  cluster_count_ = static_cast<std::uint32_t>(tables.clusters.size());
  const std::uint32_t place_count = leaf_size * leaf_count_;
  for (std::uint32_t& point : tables.far_nodes) point += place_count;
  Arrays& arrays = bodies.arrays;
  arrays.set_parameter("place_count", place_count);
  arrays.make("tree_vertex", tables.tree_vertices);
  arrays.make("spring_cluster", tables.clusters);
  arrays.make("spring_leaf", tables.leaves);
  arrays.make("near_begin", tables.near_begin);
  arrays.make("near_leaf", tables.near_leaves);
  arrays.make("far_node", tables.far_nodes);
  arrays.make("far_cluster", tables.far_clusters);
  arrays.make_reals("spring_point", std::size_t{8} * (place_count + physics::nodes_of_cluster * cluster_count_));
  arrays.make_reals("leaf_moment", std::size_t{physics::moments_size} * leaf_count_);
  arrays.make_reals("leaf_pull", std::size_t{3} * place_count);
  arrays.make_reals("node_pull", std::size_t{3} * tables.node_pull_count);
  arrays.make<double>("cluster_pull", std::size_t{physics::moments_size} * cluster_count_);
  arrays.make<double>("spring_sum", std::size_t{3} * bodies.vertex_count);
}

std::vector<Pass> ClusterForces::passes(std::uint32_t slot, bool only_stale) const {
  const Arrays& arrays = bodies_.arrays;
  const auto group_pass = [&](std::string_view name, std::uint32_t items) {
    return make_pass(arrays, name, arrays.device().group_kernel(name, threads_of_group), {{"only_stale", only_stale ? 1u : 0u}},
                     items);
  };
  return {make_pass(arrays, "sum_leaf_moments", {{"slot", slot}, {"only_stale", only_stale ? 1u : 0u}}, leaf_count_),
          group_pass("place_nodes", cluster_count_), group_pass("sum_leaf_springs", leaf_count_),
          group_pass("sum_node_pulls", cluster_count_),
          make_pass(arrays, "share_pulls", {{"only_stale", only_stale ? 1u : 0u}}, leaf_count_)};
}

}  // namespace pliant
