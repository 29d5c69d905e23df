// A vertex gets its force from the vertices of near leaves, from the nodes that its own clusters see, and from its clusters' own
// nodes, which hand down what they feel.
#define REAL_BITS 64
#include "dynamics/clusters/cluster_springs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/expect.hpp"
#include "physics/forces/spring.glsl"

namespace pliant {
namespace {

constexpr std::uint32_t grain = 4;  // leaves or clusters that a thread takes at a time

// Calls visit(item) for all items, on all threads.
void for_all(ThreadPool& pool, std::size_t count, const std::function<void(std::uint32_t)>& visit) {
  pool.for_ranges(static_cast<std::uint32_t>(count), grain, [&](std::uint32_t first, std::uint32_t end) {
    for (; first < end; ++first) visit(first);
  });
}

}  // namespace

// A leaf's vertices behind a place for the other end of their springs.
class ClusterSprings::LeafEnds {
 public:
  explicit LeafEnds(std::span<const Point> vertices) : end_(1 + vertices.size()) {
    for (std::size_t k = 0; k < vertices.size(); ++k) set(k + 1, vertices[k]);
  }

  // Returns the sum of (|x| - L)^2 [m^2] over springs to a point.
  double elongations_to(const Point& other, ElongationSum sum) {
    set(0, other);
    return sum({.rest = {rest_[0], rest_[1], rest_[2]}, .moved = {moved_[0], moved_[1], moved_[2]}}, 0, end_);
  }

 private:
  void set(std::size_t place, const Point& point) {
    for (int axis = 0; axis < 3; ++axis) {
      rest_[axis][place] = point.rest[axis];
      moved_[axis][place] = point.displacement[axis];
    }
  }

  double rest_[3][1 + leaf_size + elongation_lanes] = {}, moved_[3][1 + leaf_size + elongation_lanes] = {};
  std::size_t end_;
};

ClusterSprings::ClusterSprings(std::span<const glm::dvec3> rest, double accuracy, std::span<const glm::dvec3> shape)
    : ClusterSprings(std::make_shared<const ClusterTree>(make_cluster_tree(rest)), rest, accuracy, shape) {}

ClusterSprings::ClusterSprings(std::shared_ptr<const ClusterTree> tree, std::span<const glm::dvec3> rest, double accuracy,
                               std::span<const glm::dvec3> shape)
    : tree_(std::move(tree)) {
  ThreadPool one(1);
  pairs_ = pair_clusters(one, *tree_, accuracy, extents_moved_by(one, *tree_, rest, shape));
  for (const std::uint32_t v : tree_->order) rest_.push_back(rest[v]);
}

double ClusterSprings::energy(ThreadPool& pool, std::span<const glm::dvec3> displacements) const {
  const Points points = points_at(displacements);
  std::vector<double> of_leaves(tree_->leaves.size()), between_nodes(tree_->clusters.size());
  for_all(pool, of_leaves.size(), [&](std::uint32_t leaf) { of_leaves[leaf] = energy_of_leaf(points, leaf); });
  for_all(pool, between_nodes.size(), [&](std::uint32_t c) { between_nodes[c] = energy_between_nodes(points, c); });
  double sum = 0;
  for (const double energy : of_leaves) sum += energy;
  for (const double energy : between_nodes) sum -= energy;
  return sum;
}

std::vector<glm::dvec3> ClusterSprings::forces(ThreadPool& pool, std::span<const glm::dvec3> displacements) const {
  const Points points = points_at(displacements);
  std::vector<Shared> shared(tree_->clusters.size());
  for_all(pool, shared.size(), [&](std::uint32_t c) { shared[c] = shared_by(points, c); });
  for (std::size_t c = 1; c < shared.size(); ++c) {  // parents come first
    const Shared& above = shared[tree_->clusters[c].parent];
    const glm::dvec3 way = tree_->clusters[c].rest.centre - tree_->clusters[tree_->clusters[c].parent].rest.centre;
    shared[c].force += above.force + above.slope * way;
    shared[c].slope += above.slope;
  }
  std::vector<glm::dvec3> forces(rest_.size());
  for_all(pool, tree_->leaves.size(), [&](std::uint32_t leaf) {
    const Cluster& cluster = tree_->clusters[tree_->leaves[leaf]];
    const Shared& above = shared[tree_->leaves[leaf]];
    for (std::uint32_t place = cluster.first; place < cluster.end; ++place)
      forces[tree_->order[place]] =
          force_on_vertex(points, leaf, place) + above.force + above.slope * (rest_[place] - cluster.rest.centre);
  });
  return forces;
}

// Moments go up from leaves to the root: the sum of u, and that of u (X - centre)^T.
ClusterSprings::Points ClusterSprings::points_at(std::span<const glm::dvec3> displacements) const {
  PLIANT_EXPECT(displacements.size() == rest_.size());
  Points points{std::vector<Point>(rest_.size()),
                std::vector<std::array<Point, physics::nodes_of_cluster>>(tree_->clusters.size())};
  std::vector<Shared> moments(tree_->clusters.size());
  for (std::uint32_t place = 0; place < rest_.size(); ++place)
    points.vertices[place] = {rest_[place], displacements[tree_->order[place]]};
  for (std::size_t c = tree_->clusters.size(); c-- > 0;) {
    const Cluster& cluster = tree_->clusters[c];
    Shared& of_cluster = moments[c];
    const auto add = [&](const glm::dvec3& sum, const glm::dmat3& moment, const glm::dvec3& place) {
      of_cluster.force += sum;
      of_cluster.slope += moment + glm::outerProduct(sum, place - cluster.rest.centre);
    };
    if (cluster.is_leaf())
      for (std::uint32_t p = cluster.first; p < cluster.end; ++p) add(points.vertices[p].displacement, glm::dmat3(0.0), rest_[p]);
    else
      for (const std::uint32_t child : {cluster.first_child, cluster.first_child + 1})
        add(moments[child].force, moments[child].slope, tree_->clusters[child].rest.centre);
    for (std::uint32_t n = 0; n < physics::nodes_of_cluster; ++n) {
      points.nodes[c][n] = {cluster.rest.centre + cluster.offset_of(n),
                            (of_cluster.force + of_cluster.slope * cluster.gradient_of(n)) / static_cast<double>(cluster.size())};
    }
  }
  return points;
}

std::span<const ClusterSprings::Point> ClusterSprings::nodes_of(const Points& points, const FarCluster& far) const {
  return std::span(points.nodes[far.cluster]).subspan(physics::first_node(far.nodes), far.nodes);
}

std::span<const FarCluster> ClusterSprings::far_of(std::uint32_t cluster) const {
  return std::span(pairs_.far).subspan(pairs_.far_begin[cluster], pairs_.far_begin[cluster + 1] - pairs_.far_begin[cluster]);
}

// How many vertices a node stands for.
double ClusterSprings::weight_of(std::uint32_t cluster, std::uint32_t nodes) const {
  return static_cast<double>(tree_->clusters[cluster].size()) / nodes;
}

// Returns the energy of springs to vertices of this leaf and of near leaves before it, and to far nodes.
double ClusterSprings::energy_of_leaf(const Points& points, std::uint32_t leaf) const {
  const Cluster& cluster = tree_->clusters[tree_->leaves[leaf]];
  LeafEnds ends(std::span(points.vertices).subspan(cluster.first, cluster.size()));
  const auto energy_with = [&](const Point& other) { return 0.5 * ends.elongations_to(other, sum_); };
  double sum = 0;
  for (std::uint32_t k = pairs_.near_begin[leaf]; k < pairs_.near_begin[leaf + 1]; ++k) {
    if (pairs_.near[k] > leaf) continue;
    const Cluster& near = tree_->clusters[tree_->leaves[pairs_.near[k]]];
    const double part = pairs_.near[k] == leaf ? 0.5 : 1;  // each spring of its own comes twice
    for (std::uint32_t place = near.first; place < near.end; ++place) sum += part * energy_with(points.vertices[place]);
  }
  for (std::uint32_t c = tree_->leaves[leaf];; c = tree_->clusters[c].parent) {
    for (const FarCluster& far : far_of(c))
      for (const Point& node : nodes_of(points, far)) sum += weight_of(far.cluster, far.nodes) * energy_with(node);
    if (c == 0) return sum;
  }
}

// Of pairs with clusters that come later.
double ClusterSprings::energy_between_nodes(const Points& points, std::uint32_t cluster) const {
  double sum = 0;
  for (const FarCluster& far : far_of(cluster)) {
    if (far.cluster < cluster) continue;
    for (const Point& own : nodes_of(points, {cluster, far.nodes}))
      for (const Point& other : nodes_of(points, far))
        sum += weight_of(cluster, far.nodes) * weight_of(far.cluster, far.nodes) * 0.5 *
               elongation_squared(own.rest - other.rest, own.displacement - other.displacement);
  }
  return sum;
}

glm::dvec3 ClusterSprings::force_between(const Point& own, const Point& other) {
  const glm::dvec3 change = own.displacement - other.displacement, x = own.rest - other.rest + change;
  return -physics64::spring_strain(x, change) * x;
}

glm::dvec3 ClusterSprings::force_on_vertex(const Points& points, std::uint32_t leaf, std::uint32_t place) const {
  const Point& own = points.vertices[place];
  glm::dvec3 sum(0.0);
  for (std::uint32_t k = pairs_.near_begin[leaf]; k < pairs_.near_begin[leaf + 1]; ++k) {
    const Cluster& near = tree_->clusters[tree_->leaves[pairs_.near[k]]];
    for (std::uint32_t p = near.first; p < near.end; ++p) sum += force_between(own, points.vertices[p]);
  }
  for (std::uint32_t c = tree_->leaves[leaf];; c = tree_->clusters[c].parent) {
    for (const FarCluster& far : far_of(c))
      for (const Point& node : nodes_of(points, far)) sum += weight_of(far.cluster, far.nodes) * force_between(own, node);
    if (c == 0) return sum;
  }
}

// A node is pulled by all vertices of a far cluster, less what that cluster's nodes pull.
ClusterSprings::Shared ClusterSprings::shared_by(const Points& points, std::uint32_t cluster) const {
  Shared shared;
  for (const FarCluster& far : far_of(cluster)) {
    const Cluster& other = tree_->clusters[far.cluster];
    for (std::uint32_t n = physics::first_node(far.nodes); n < physics::first_node(far.nodes) + far.nodes; ++n) {
      const Point& own = points.nodes[cluster][n];
      glm::dvec3 pull(0.0);
      for (std::uint32_t place = other.first; place < other.end; ++place) pull += force_between(own, points.vertices[place]);
      for (const Point& node : nodes_of(points, far)) pull -= weight_of(far.cluster, far.nodes) * force_between(own, node);
      pull /= far.nodes;
      shared.force += pull;
      shared.slope += glm::outerProduct(pull, tree_->clusters[cluster].gradient_of(n));
    }
  }
  return shared;
}

}  // namespace pliant
