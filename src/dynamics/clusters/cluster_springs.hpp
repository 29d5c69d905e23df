// Sums the springs of a clustered body in fp64: its energy and its forces.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_tree.hpp"
#include "dynamics/forces/elongations.hpp"

namespace pliant {

/// Sums have the same bits on any number of threads.
class ClusterSprings {
 public:
  /// `rest` are positions at rest [m], at least one. pair_clusters() says what `accuracy` is. With `shape`, lists suit a shape
  /// with these displacements [m], too.
  ClusterSprings(std::span<const glm::dvec3> rest, double accuracy, std::span<const glm::dvec3> shape = {});
  /// The same with a tree that has been made of `rest`.
  ClusterSprings(std::shared_ptr<const ClusterTree> tree, std::span<const glm::dvec3> rest, double accuracy,
                 std::span<const glm::dvec3> shape);

  /// Returns the energy of the body over its stiffness [m^2]. `displacements` are those of the vertices [m].
  [[nodiscard]] double energy(ThreadPool& pool, std::span<const glm::dvec3> displacements) const;
  /// Returns the forces on the vertices over the stiffness [m]: the gradient of the energy with its sign changed.
  [[nodiscard]] std::vector<glm::dvec3> forces(ThreadPool& pool, std::span<const glm::dvec3> displacements) const;

  [[nodiscard]] SpringCounts counts() const { return count_springs(*tree_, pairs_); }

 private:
  // A vertex, or a node.
  struct Point {
    glm::dvec3 rest{0.0}, displacement{0.0};
  };
  struct Points {
    std::vector<Point> vertices;                                      // by their places in the tree
    std::vector<std::array<Point, physics::nodes_of_cluster>> nodes;  // of each cluster
  };
  // What a cluster's nodes hand down: a vertex at X gets force + slope (X - centre).
  struct Shared {
    glm::dvec3 force{0.0};
    glm::dmat3 slope{0.0};
  };

  // Returns the force that a spring from `own` to `other` exerts on it, over the stiffness [m].
  [[nodiscard]] static glm::dvec3 force_between(const Point& own, const Point& other);
  [[nodiscard]] Points points_at(std::span<const glm::dvec3> displacements) const;
  [[nodiscard]] std::span<const Point> nodes_of(const Points& points, const FarCluster& far) const;
  [[nodiscard]] std::span<const FarCluster> far_of(std::uint32_t cluster) const;
  [[nodiscard]] double weight_of(std::uint32_t cluster, std::uint32_t nodes) const;
  [[nodiscard]] double energy_of_leaf(const Points& points, std::uint32_t leaf) const;
  [[nodiscard]] double energy_between_nodes(const Points& points, std::uint32_t cluster) const;
  [[nodiscard]] glm::dvec3 force_on_vertex(const Points& points, std::uint32_t leaf, std::uint32_t place) const;
  [[nodiscard]] Shared shared_by(const Points& points, std::uint32_t cluster) const;

  class LeafEnds;

  ElongationSum sum_ = elongation_sum(cpu::available_isas().back());
  std::shared_ptr<const ClusterTree> tree_;
  std::vector<glm::dvec3> rest_;  // by places in the tree [m]
  ClusterPairs pairs_;
};

}  // namespace pliant
