// The trees of all clustered bodies stand one after another in the same arrays.
#include "dynamics/clusters/cluster_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_tree.hpp"
#include "physics/forces/clusters.glsl"

namespace pliant {
namespace {

static_assert(physics::bank_row == physics::group_size + 1 && physics::places_of_tile == physics::group_size);

constexpr std::uint32_t threads_of_nodes = 32;  // most clusters have one leaf or two, which 24 threads sum
static_assert(threads_of_nodes <= 64, "place_nodes.glsl has no more memory in common");

struct Tables {
  std::vector<std::uint32_t> tree_vertices;
  std::vector<physics::SpringCluster> clusters;
  std::vector<glm::uvec4> leaves;
  std::vector<std::uint32_t> near_leaves, above_clusters;
  std::vector<glm::uvec2> far_clusters;
  std::uint64_t pull_row_count = 0;
};

void store(double* to, const glm::dvec3& from) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

physics::SpringCluster table_row(const Cluster& cluster) {
  physics::SpringCluster row{};
  store(row.centre, cluster.rest.centre);
  for (int m = 0; m < 3; ++m) store(row.slope + 3 * m, cluster.slopes[m]);
  store(row.squares, cluster.squares);
  row.vertex_count = cluster.size();
  return row;
}

class BodyTables {
 public:
  BodyTables(ThreadPool& pool, Tables& tables, const Model& model, std::uint32_t body_index, const ListBasis& basis,
             std::shared_ptr<const ClusterTree> tree)
      : tables_(tables),
        body_(model.bodies[body_index]),
        body_index_(body_index),
        first_cluster_(static_cast<std::uint32_t>(tables.clusters.size())),
        first_leaf_(static_cast<std::uint32_t>(tables.leaves.size())),
        tree_(std::move(tree)) {
    const std::vector<glm::dvec3> rest = model.rest_positions_of(body_);
    pairs_ = pair_clusters(pool, *tree_, basis.accuracy, extents_moved_by(pool, *tree_, rest, basis.displacements));
    add_leaves();
    add_clusters();
    pool.for_ranges(
        static_cast<std::uint32_t>(tables.clusters.size() - first_cluster_), 64,
        [&](std::uint32_t first, std::uint32_t end) { set_places_of_pulls(first_cluster_ + first, first_cluster_ + end); });
  }

  [[nodiscard]] std::uint64_t spring_count() const { return count_springs(*tree_, pairs_).all(); }

  // Returns vertices from all over the body, the same ones each time.
  [[nodiscard]] std::vector<std::uint32_t> samples() const {
    const std::uint64_t count = std::min<std::uint64_t>(physics::most_samples, tree_->order.size());
    std::vector<std::uint32_t> vertices;
    for (std::uint64_t s = 0; s < count; ++s)
      vertices.push_back(body_.first_vertex + tree_->order[(2 * s + 1) * tree_->order.size() / (2 * count)]);
    return vertices;
  }

 private:
  void add_leaves() {
    for (std::uint32_t leaf = 0; leaf < tree_->leaves.size(); ++leaf) {
      const std::uint32_t of_leaf = tree_->leaves[leaf];
      const Cluster& cluster = tree_->clusters[of_leaf];
      tables_.leaves.emplace_back(body_index_, first_cluster_ + of_leaf, tables_.near_leaves.size(),
                                  tables_.above_clusters.size());
      for (std::uint32_t k = 0; k < leaf_size; ++k)  // behind the end of the last leaf its last vertex comes again
        tables_.tree_vertices.push_back(body_.first_vertex + tree_->order[std::min(cluster.first + k, cluster.end - 1)]);
      for (std::uint32_t k = pairs_.near_begin[leaf]; k < pairs_.near_begin[leaf + 1]; ++k)
        tables_.near_leaves.push_back(first_leaf_ + pairs_.near[k]);
      for (std::uint32_t c = of_leaf;; c = tree_->clusters[c].parent) {
        if (pairs_.far_begin[c] < pairs_.far_begin[c + 1]) tables_.above_clusters.push_back(first_cluster_ + c);
        if (c == 0) break;
      }
    }
  }

  void add_clusters() {
    for (std::uint32_t c = 0; c < tree_->clusters.size(); ++c) {
      const Cluster& cluster = tree_->clusters[c];
      physics::SpringCluster row = table_row(cluster);
      row.body_index = body_index_;
      row.first_leaf = first_leaf_ + cluster.first_leaf();
      row.end_leaf = first_leaf_ + cluster.end_leaf();
      row.first_far = static_cast<std::uint32_t>(tables_.far_clusters.size());
      row.first_pull = static_cast<std::uint32_t>(tables_.pull_row_count);
      row.leaf_pulls_on_one = list_far(c, 1);
      tables_.pull_row_count += physics::rows_of_one(row.leaf_pulls_on_one);
      row.first_far_four = static_cast<std::uint32_t>(tables_.far_clusters.size());
      tables_.pull_row_count += list_far(c, 4);
      row.end_far = static_cast<std::uint32_t>(tables_.far_clusters.size());
      row.end_pull = static_cast<std::uint32_t>(tables_.pull_row_count);
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
  void set_places_of_pulls(std::uint32_t first_cluster, std::uint32_t end_cluster) {
    for (std::uint32_t c = first_cluster; c < end_cluster; ++c) {
      const physics::SpringCluster& row = tables_.clusters[c];
      std::uint32_t place = physics::pull_row_size * row.first_pull;
      for (std::uint32_t k = row.first_far; k < row.end_far; ++k) {
        if (k == row.first_far_four)
          place = physics::pull_row_size * (row.first_pull + physics::rows_of_one(row.leaf_pulls_on_one));
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
    const Cluster& cluster = tree_->clusters[c - first_cluster_];
    return cluster.end_leaf() - cluster.first_leaf();
  }

  Tables& tables_;
  const ModelBody& body_;
  std::uint32_t body_index_, first_cluster_, first_leaf_;
  std::shared_ptr<const ClusterTree> tree_;
  ClusterPairs pairs_;
};

// Adds leaves of samples. Each comes parts_of_sample times, and sees a part of the body's leaves one by one.
void add_samples(Tables& tables, std::uint32_t body, std::span<const std::uint32_t> samples, std::uint32_t first_leaf,
                 std::uint32_t end_leaf) {
  for (std::size_t first = 0; first < samples.size(); first += leaf_size) {
    const std::size_t count = std::min<std::size_t>(leaf_size, samples.size() - first);
    physics::SpringCluster cluster{};
    cluster.body_index = body;
    cluster.vertex_count = static_cast<std::uint32_t>(count);
    for (std::uint32_t part = 0; part < physics::parts_of_sample; ++part) {
      tables.leaves.emplace_back(body, tables.clusters.size(), tables.near_leaves.size(), tables.above_clusters.size());
      for (std::size_t k = 0; k < leaf_size; ++k) tables.tree_vertices.push_back(samples[first + std::min(k, count - 1)]);
      const auto begin_of = [&](std::uint64_t p) {
        return first_leaf + static_cast<std::uint32_t>(p * (end_leaf - first_leaf) / physics::parts_of_sample);
      };
      for (std::uint32_t leaf = begin_of(part); leaf < begin_of(part + 1); ++leaf) tables.near_leaves.push_back(leaf);
    }
    tables.clusters.push_back(cluster);
  }
}

// Numbers of `node_pull`, and of the two vectors of each point, are counted in 32 bits.
void expect_countable(const Tables& tables) {
  constexpr std::uint64_t most = 0xffffffffu;
  const std::uint64_t points = leaf_size * tables.leaves.size() + physics::nodes_of_cluster * tables.clusters.size();
  if (physics::pull_row_size * tables.pull_row_count > most || 8 * points > most || tables.near_leaves.size() > most)
    throw Error(ErrorKind::input, "", "lists of clusters would be too long", "take a larger force_tolerance, or coarser meshes");
}

std::uint32_t tiles_of(std::uint32_t leaves) { return (leaves + physics::leaves_of_tile - 1) / physics::leaves_of_tile; }

}  // namespace

double ClusterErrors::relative() const {
  constexpr double least_part = 0.05;  // of what clusters hand down
  if (error == 0 && handed_down == 0) return 0;
  const double larger = std::max(error / sum, least_part * handed_down / sum_of_all);
  return std::isfinite(larger) ? larger : std::numeric_limits<double>::infinity();
}

// Half, because steps go on while energies of a change are summed. A pool with a thread for each processor would also pin its
// threads (core/thread_pool.hpp).
unsigned list_threads(const DeviceInfo& device) {
  return std::clamp((device.kind == DeviceKind::cpu ? device.threads : thread_count(0)) / 2, 1u, 8u);
}

ThreadPool& ClusterTrees::pool() {
  if (!pool_) pool_ = std::make_unique<ThreadPool>(threads_);
  return *pool_;
}

std::shared_ptr<const ClusterTree> ClusterTrees::of(const Model& model, std::uint32_t body) {
  trees_.resize(model.bodies.size());
  if (!trees_[body])
    trees_[body] = std::make_shared<const ClusterTree>(make_cluster_tree(model.rest_positions_of(model.bodies[body])));
  return trees_[body];
}

ClusterForces::ClusterForces(DeviceBodies& bodies, const Model& model, std::span<const std::optional<ListBasis>> bases,
                             ClusterTrees& trees)
    : bodies_(&bodies), springs_of_bodies_(model.bodies.size()) {
  PLIANT_EXPECT(bases.size() == model.bodies.size());
  Tables tables;
  std::vector<std::vector<std::uint32_t>> samples;
  const auto leaf_count = [&] { return static_cast<std::uint32_t>(tables.leaves.size()); };
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    if (!bases[b]) continue;
    Leaves leaves{
        .body = b, .vertices = model.bodies[b].vertex_count, .first = leaf_count(), .end = 0, .first_sample = 0, .end_sample = 0};
    const BodyTables added(trees.pool(), tables, model, b, *bases[b], trees.of(model, b));
    springs_of_bodies_[b] = added.spring_count();
    leaves.end = leaf_count();
    leaves_of_bodies_.push_back(leaves);
    samples.push_back(added.samples());
  }
  leaf_count_ = leaf_count();
  cluster_count_ = static_cast<std::uint32_t>(tables.clusters.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    Leaves& leaves = leaves_of_bodies_[k];
    leaves.first_sample = leaf_count();
    add_samples(tables, leaves.body, samples[k], leaves.first, leaves.end);
    leaves.end_sample = leaf_count();
  }
  leaves_and_samples_ = leaf_count();
  expect_countable(tables);
  tables.leaves.emplace_back(0, 0, tables.near_leaves.size(), tables.above_clusters.size());
  const std::uint32_t place_count = leaf_size * leaves_and_samples_;
  Arrays& arrays = bodies.arrays;
  arrays.set_parameter("place_count", place_count);
  arrays.make("tree_vertex", tables.tree_vertices);
  arrays.make("spring_cluster", tables.clusters);
  arrays.make("spring_leaf", tables.leaves);
  arrays.make("near_leaf", tables.near_leaves);
  arrays.make("above_cluster", tables.above_clusters);
  arrays.make("far_cluster", tables.far_clusters);
  const auto make_reals = [&](std::string_view name, std::size_t count) { arrays.make_reals(name, count, Content::anything); };
  const auto make_doubles = [&](std::string_view name, std::size_t count) {
    arrays.make<double>(name, count, Content::anything);
  };
  make_reals("spring_point", std::size_t{8} * (place_count + std::size_t{physics::nodes_of_cluster} * cluster_count_));
  make_doubles("leaf_moment", std::size_t{physics::moments_size} * leaves_and_samples_);
  make_reals("leaf_pull", std::size_t{3} * place_count);
  make_reals("node_pull", std::size_t{physics::pull_row_size} * tables.pull_row_count);
  make_doubles("cluster_pull", std::size_t{physics::moments_size} * cluster_count_);
  make_doubles("leaf_square", std::size_t{3} * leaves_and_samples_);
  make_doubles("spring_sum", std::size_t{3} * bodies.vertex_count);
}

std::vector<Pass> ClusterForces::passes(std::uint32_t slot, bool only_stale) const {
  return passes_up_to(leaf_count_, slot, only_stale);
}

std::vector<Pass> ClusterForces::passes_up_to(std::uint32_t end_leaf, std::uint32_t slot, bool only_stale) const {
  const Parameters of_clusters = {{"only_stale", only_stale ? 1u : 0u}};
  const auto of_leaves_before = [&](std::uint32_t end) {
    return Parameters{{"only_stale", only_stale ? 1u : 0u}, {"first_leaf", 0u}, {"end_leaf", end}};
  };
  Parameters in_slot = of_leaves_before(end_leaf);
  in_slot.emplace_back("slot", slot);
  return {group_pass("sum_leaf_moments", tiles_of(end_leaf), in_slot),
          group_pass("place_nodes", cluster_count_, of_clusters, threads_of_nodes),
          group_pass("sum_leaf_springs", end_leaf, of_leaves_before(end_leaf)),
          group_pass("sum_node_pulls", cluster_count_, of_clusters),
          group_pass("share_pulls", tiles_of(leaf_count_), of_leaves_before(leaf_count_))};
}

std::vector<Pass> ClusterForces::measuring_passes(std::uint32_t slot) const {
  std::vector<Pass> all = passes_up_to(leaves_and_samples_, slot, false);
  const Parameters of_all = {
      {"only_stale", 0u}, {"first_leaf", 0u}, {"end_leaf", leaves_and_samples_}, {"first_sample", leaf_count_}};
  all.push_back(make_pass(bodies_->arrays, "square_sums", of_all, leaves_and_samples_));
  return all;
}

Pass ClusterForces::group_pass(std::string_view name, std::uint32_t items, const Parameters& parameters,
                               std::uint32_t threads) const {
  return make_pass(bodies_->arrays, name, bodies_->arrays.device().group_kernel(name, threads), parameters, items);
}

std::vector<ClusterErrors> ClusterForces::errors() const {
  const std::vector<double> squares = bodies_->arrays.get<double>("leaf_square").download();
  const auto rms = [&](std::uint32_t first, std::uint32_t end, std::uint32_t which, std::size_t vertices) {
    double sum = 0;
    for (std::uint32_t leaf = first; leaf < end; ++leaf) sum += squares[std::size_t{3} * leaf + which];
    return std::sqrt(sum / static_cast<double>(vertices));
  };
  std::vector<ClusterErrors> errors(springs_of_bodies_.size());
  for (const Leaves& of : leaves_of_bodies_) {
    const std::size_t vertices = of.vertices, samples = std::min<std::size_t>(physics::most_samples, vertices);
    errors[of.body] = {.error = rms(of.first_sample, of.end_sample, 0, samples),
                       .sum = rms(of.first_sample, of.end_sample, 1, samples),
                       .size = rms(of.first_sample, of.end_sample, 2, samples),
                       .handed_down = rms(of.first, of.end, 0, vertices),
                       .sum_of_all = rms(of.first, of.end, 1, vertices)};
  }
  return errors;
}

}  // namespace pliant
