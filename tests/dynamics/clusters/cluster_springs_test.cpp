// The laws of springs by clusters, and how near they are to springs between all pairs.
#include "dynamics/clusters/cluster_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <new>
#include <random>
#include <stdexcept>

#include "bench/dense/deformations.hpp"
#include "bench/dense/exact_forces.hpp"
#include "core/error.hpp"
#include "mesh/generators.hpp"
#include "support/no_more_memory.hpp"

namespace pliant {
namespace {

using bench::Deformation;
using Vectors = std::vector<glm::dvec3>;

Vectors rest_of(std::string_view mesh) { return bench::scaled_to_radius_1(generate_mesh(mesh).positions); }

Vectors random_points(std::size_t count, const glm::dvec3& size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Vectors points;
  while (points.size() < count) points.push_back(size * glm::dvec3(coordinate(random), coordinate(random), coordinate(random)));
  return points;
}

double direct_energy(const Vectors& rest, const Vectors& displacements) {
  double sum = 0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t j = i + 1; j < rest.size(); ++j) {
      const double now = glm::length(rest[i] + displacements[i] - rest[j] - displacements[j]);
      sum += 0.5 * std::pow(now - glm::length(rest[i] - rest[j]), 2);
    }
  return sum;
}

double error_of(const Vectors& forces, const Vectors& rest, const Vectors& displacements) {
  ThreadPool pool(1);
  return bench::ExactForces(pool, rest, displacements, 200).error_of([&](std::size_t i) { return forces[i]; });
}

double sum_of_sizes(const Vectors& vectors) {
  double sum = 0;
  for (const glm::dvec3& v : vectors) sum += glm::length(v);
  return sum;
}

TEST_CASE("clusters cover every vertex once, and their nodes move with them in linear motions") {
  for (const std::size_t count : {1, 15, 16, 17, 33, 1000}) {
    const Vectors rest = random_points(count, {1, 0.5, 0.2});
    const ClusterTree tree = make_cluster_tree(rest);
    std::vector<int> seen(count);
    for (const std::uint32_t v : tree.order) ++seen.at(v);
    CHECK(std::ranges::count(seen, 1) == static_cast<std::ptrdiff_t>(count));
    REQUIRE(tree.leaves.size() == (count + leaf_size - 1) / leaf_size);
    for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf) {
      const Cluster& cluster = tree.clusters[tree.leaves[leaf]];
      CHECK(cluster.is_leaf());
      CHECK(cluster.first == leaf * leaf_size);
      CHECK(cluster.end == std::min<std::size_t>(cluster.first + leaf_size, count));
    }
    const glm::dmat3 motion(0.3, -1, 2, 0.7, 1.4, -0.6, 0.2, 0.9, 3);
    for (const Cluster& cluster : tree.clusters) {
      if (!cluster.is_leaf()) {
        const Cluster &first = tree.clusters[cluster.first_child], &second = tree.clusters[cluster.first_child + 1];
        CHECK((first.first == cluster.first && first.end == second.first && second.end == cluster.end));
      }
      for (std::uint32_t node = 0; node < physics::nodes_of_cluster; ++node) {
        glm::dvec3 moved(0.0), mean(0.0);
        for (std::uint32_t place = cluster.first; place < cluster.end; ++place) {
          const glm::dvec3 arm = rest[tree.order[place]] - cluster.rest.centre;
          CHECK(glm::length(arm) <= cluster.rest.radius * (1 + 1e-12));
          mean += arm;
          moved += (1 + glm::dot(cluster.gradient_of(node), arm)) * (motion * arm);
        }
        const double n = cluster.size();
        CHECK(glm::length(mean / n) < 1e-13);
        if (cluster.size() > 3) CHECK(glm::length(moved / n - motion * cluster.offset_of(node)) < 1e-10);
      }
    }
  }
}

TEST_CASE("pairs of clusters cover every pair of vertices once, and both sides list each other") {
  ThreadPool pool(3);
  for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
    const Vectors rest = random_points(1003, {1, 1, 0.3});
    const ClusterTree tree = make_cluster_tree(rest);
    const ClusterPairs pairs = pair_clusters(pool, tree, accuracy);
    std::vector<std::vector<int>> covered(rest.size(), std::vector<int>(rest.size()));
    const auto cover = [&](const Cluster& a, const Cluster& b) {
      for (std::uint32_t i = a.first; i < a.end; ++i)
        for (std::uint32_t j = b.first; j < b.end; ++j) ++covered[i][j];
    };
    std::size_t far_pairs = 0;
    SpringCounts counts;
    std::uint64_t far_springs = 0;  // between vertices, each from both ends
    for (std::uint32_t leaf = 0; leaf < tree.leaves.size(); ++leaf)
      for (std::uint32_t k = pairs.near_begin[leaf]; k < pairs.near_begin[leaf + 1]; ++k)
        cover(tree.clusters[tree.leaves[leaf]], tree.clusters[tree.leaves[pairs.near[k]]]);
    for (std::uint32_t c = 0; c < tree.clusters.size(); ++c)
      for (std::uint32_t k = pairs.far_begin[c]; k < pairs.far_begin[c + 1]; ++k, ++far_pairs) {
        const Cluster &first = tree.clusters[c], &second = tree.clusters[pairs.far[k].cluster];
        cover(first, second);
        CHECK(first.rest.radius + second.rest.radius <= glm::length(first.rest.centre - second.rest.centre));
        counts.far += std::uint64_t{first.size()} * pairs.far[k].nodes;
        counts.between_nodes += std::uint64_t{pairs.far[k].nodes} * pairs.far[k].nodes;
        far_springs += std::uint64_t{first.size()} * second.size();
      }
    for (const std::vector<int>& row : covered) REQUIRE(std::ranges::count(row, 1) == static_cast<std::ptrdiff_t>(row.size()));
    CHECK(far_pairs > 0);
    const SpringCounts told = ClusterSprings(rest, accuracy).counts();
    CHECK(2 * told.near + far_springs == std::uint64_t{rest.size()} * (rest.size() - 1));
    CHECK(told.far == counts.far);
    CHECK(2 * told.between_nodes == counts.between_nodes);
  }
}

TEST_CASE("vertices in one place pull each other in no direction, and others as all springs do") {
  Vectors rest = random_points(301, {1, 1, 0.3});
  for (glm::dvec3& p : rest) p = glm::round(1024.0 * p) / 1024.0;  // so that they can meet without rounding
  rest[21] = rest[20];
  Vectors displacements(rest.size());
  for (std::size_t i = 1; i < 20; ++i) displacements[i] = rest[0] - rest[i];
  ThreadPool pool(1);
  const ClusterSprings all_near(rest, 1e-30);
  REQUIRE(all_near.counts().far == 0);
  const Vectors forces = all_near.forces(pool, displacements);
  const bench::ExactForces exact(pool, rest, displacements, rest.size());
  CHECK(exact.error_of([&](std::size_t i) { return forces[i]; }) < 1e-12);
}

TEST_CASE("lists may have as many entries as are allowed, and no more") {
  ThreadPool pool(2);
  const ClusterTree tree = make_cluster_tree(random_points(1003, {1, 1, 0.3}));
  const ClusterPairs pairs = pair_clusters(pool, tree, 1e-7);
  const std::uint64_t entries = pairs.near.size() + pairs.far.size();
  CHECK(pair_clusters(pool, tree, 1e-7, {}, entries).near == pairs.near);
  try {
    static_cast<void>(pair_clusters(pool, tree, 1e-7, {}, entries - 1));
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
  }
}

#ifdef PLIANT_CAN_RUN_OUT_OF_MEMORY
// All pairs of leaves would take 17 GB.
TEST_CASE("lists that would be too long are an error before memory runs out, and if it runs out first, that is another") {
  ThreadPool pool(2);
  const ClusterTree tree = make_cluster_tree(Vectors(1u << 20, glm::dvec3(1.0)));
  const auto ends_at_limit = [&](std::uint64_t most_entries) {
    try {
      const test::NoMoreMemory tight;
      static_cast<void>(pair_clusters(pool, tree, 1e-7, {}, most_entries));
    } catch (const Error& error) {
      return error.kind() == ErrorKind::input;
    } catch (const std::bad_alloc&) {
      return false;
    }
    throw std::logic_error("there was memory");
  };
  CHECK(ends_at_limit(100'000));
  CHECK_FALSE(ends_at_limit(most_list_entries));
}
#endif

TEST_CASE("pairs of clusters and their order do not depend on the number of threads") {
  const Vectors rest = random_points(3001, {1, 1, 0.3}), displacements = random_points(3001, {0.1, 0.1, 0.1});
  const ClusterTree tree = make_cluster_tree(rest);
  ThreadPool one(1);
  const std::vector<Extent> shape = extents_moved_by(one, tree, rest, displacements);
  const ClusterPairs expected = pair_clusters(one, tree, 1e-7, shape);
  for (const unsigned threads : {2u, 7u}) {
    ThreadPool pool(threads);
    const std::vector<Extent> same_shape = extents_moved_by(pool, tree, rest, displacements);
    for (std::size_t c = 0; c < shape.size(); ++c) {
      CHECK(same_shape[c].centre == shape[c].centre);
      CHECK(same_shape[c].radius == shape[c].radius);
      CHECK(same_shape[c].spread_squared == shape[c].spread_squared);
    }
    const ClusterPairs pairs = pair_clusters(pool, tree, 1e-7, same_shape);
    CHECK(pairs.near_begin == expected.near_begin);
    CHECK(pairs.near == expected.near);
    CHECK(pairs.far_begin == expected.far_begin);
    CHECK(std::ranges::equal(pairs.far, expected.far, [](const FarCluster& a, const FarCluster& b) {
      return a.cluster == b.cluster && a.nodes == b.nodes;
    }));
  }
}

TEST_CASE("forces by clusters are the gradient of their energy") {
  ThreadPool pool(1);
  const Vectors rest = rest_of("icosphere:3");
  const ClusterSprings springs(rest, 1e-6);
  REQUIRE(springs.counts().far > springs.counts().near);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const Deformation& deformation : bench::deformations_of(rest)) {
    if (deformation.name == "smooth 0.0001") continue;  // too small for differences
    CAPTURE(deformation.name);
    const Vectors forces = springs.forces(pool, deformation.displacements);
    Vectors way(rest.size());
    for (glm::dvec3& v : way) v = glm::dvec3(normal(random), normal(random), normal(random));
    double slope = 0, size = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      slope -= glm::dot(forces[i], way[i]);
      size += glm::length(forces[i]) * glm::length(way[i]);
    }
    constexpr double step = 1e-5;
    Vectors ahead = deformation.displacements, behind = deformation.displacements;
    for (std::size_t i = 0; i < rest.size(); ++i) ahead[i] += step * way[i], behind[i] -= step * way[i];
    const double difference = (springs.energy(pool, ahead) - springs.energy(pool, behind)) / (2 * step);
    CHECK(std::abs(difference - slope) < 1e-6 * size);
  }
}

TEST_CASE("forces by clusters add up to no force and no torque") {
  ThreadPool pool(1);
  const Vectors rest = rest_of("icosphere:4");
  const ClusterSprings springs(rest, 1e-7);
  for (const Deformation& deformation : bench::deformations_of(rest)) {
    CAPTURE(deformation.name);
    const Vectors forces = springs.forces(pool, deformation.displacements);
    glm::dvec3 force(0.0), torque(0.0);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      force += forces[i];
      torque += glm::cross(rest[i] + deformation.displacements[i], forces[i]);
    }
    CHECK(glm::length(force) < 1e-13 * sum_of_sizes(forces));
    CHECK(glm::length(torque) < 1e-13 * sum_of_sizes(forces));
  }
}

TEST_CASE("a clustered body feels nothing at rest, moved and turned, and breathes as one with all springs") {
  ThreadPool pool(1);
  const Vectors rest = rest_of("icosphere:4");
  const ClusterSprings springs(rest, 1e-6);
  const glm::dquat turn = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, -2, 0.5)));
  Vectors turned, breathing;
  for (const glm::dvec3& p : rest) {
    turned.push_back(turn * p + glm::dvec3(3, 1, -2) - p);
    breathing.push_back(0.3 * p);
  }
  CHECK(springs.energy(pool, Vectors(rest.size())) == 0);
  CHECK(sum_of_sizes(springs.forces(pool, Vectors(rest.size()))) == 0);
  CHECK(sum_of_sizes(springs.forces(pool, turned)) < 1e-11 * static_cast<double>(rest.size() * rest.size()));
  const Vectors forces = springs.forces(pool, breathing);
  for (std::size_t i = 0; i < rest.size(); i += 100) {
    const glm::dvec3 exact = -0.3 * static_cast<double>(rest.size()) * rest[i];  // as the mean of all positions is 0
    CHECK(glm::length(forces[i] - exact) < 1e-11 * glm::length(exact));
  }
}

// All springs have the stiffest mode N k in every shape.
TEST_CASE("the stiffest mode of a clustered body is that of all springs, at rest and bent") {
  ThreadPool pool(2);
  const Vectors rest = rest_of("icosphere:3");
  const ClusterSprings springs(rest, 1e-6);
  const std::vector<Deformation> deformations = bench::deformations_of(rest);
  for (const Vectors& shape : {Vectors(rest.size()), deformations[2].displacements}) {
    const Vectors before = springs.forces(pool, shape);
    Vectors mode = random_points(rest.size(), glm::dvec3(1));
    double stiffness = 0;
    for (int round = 0; round < 100; ++round) {
      constexpr double step = 1e-6;
      double size = 0;
      for (const glm::dvec3& v : mode) size += glm::dot(v, v);
      Vectors moved = shape;
      for (std::size_t i = 0; i < rest.size(); ++i) moved[i] += step / std::sqrt(size) * mode[i];
      const Vectors after = springs.forces(pool, moved);
      double squared = 0;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        mode[i] = (before[i] - after[i]) / step;
        squared += glm::dot(mode[i], mode[i]);
      }
      stiffness = std::sqrt(squared);
    }
    CHECK(stiffness == Approx(rest.size()).epsilon(1e-4));
  }
}

TEST_CASE("neighbours move apart by as much as a deformation says") {
  const Vectors rest = rest_of("icosphere:4");
  const std::vector<Deformation> deformations = bench::deformations_of(rest);
  for (const double size : {0.003, 0.008, 0.03}) {
    const auto found = std::ranges::find(deformations, fmt::format("dephased {}", size), &Deformation::name);
    REQUIRE(found != deformations.end());
    double squares = 0, of_steps = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      squares += dot(found->displacements[i], found->displacements[i]);
      const glm::dvec3 step = found->displacements[i] - found->displacements[(i + 1) % rest.size()];
      of_steps += dot(step, step);
    }
    CHECK(std::sqrt(squares / static_cast<double>(rest.size())) == Approx(size));
    CHECK(std::sqrt(of_steps / static_cast<double>(rest.size())) == Approx(std::sqrt(2.0) * size).epsilon(0.1));
  }
}

// Bounds are 1.5 times the errors of a prototype for 40,962 vertices, relative to the root of the mean square of forces.
TEST_CASE("forces by clusters have errors as small as their accuracy says") {
  ThreadPool pool(2);
  const Vectors rest = rest_of("icosphere:5");
  const std::vector<Deformation> deformations = bench::deformations_of(rest);
  struct Bounds {
    double accuracy, smooth, stretched, dent, dephased[3];
  };
  for (const Bounds& bounds : {Bounds{1e-6, 1.1e-3, 8.3e-4, 1.2e-3, {2.4e-3, 2.3e-3, 2.2e-3}},
                               Bounds{1e-7, 3.0e-4, 2.4e-4, 3.5e-4, {7.6e-4, 7.1e-4, 1.3e-3}},
                               Bounds{1e-8, 7.9e-5, 5.5e-5, 8.1e-5, {2.8e-4, 2.5e-4, 1.1e-3}}}) {
    const ClusterSprings springs(rest, bounds.accuracy);
    std::size_t dephased = 0;
    for (const Deformation& deformation : deformations) {
      if (deformation.is_crushed) continue;
      CAPTURE(bounds.accuracy, deformation.name);
      const double bound = deformation.name == "stretched"            ? bounds.stretched
                           : deformation.name == "dent"               ? bounds.dent
                           : deformation.name.starts_with("dephased") ? bounds.dephased[dephased++]
                                                                      : bounds.smooth;
      CHECK(error_of(springs.forces(pool, deformation.displacements), rest, deformation.displacements) < 1.5 * bound);
    }
  }
}

TEST_CASE("a tolerance is met three times over in smooth deformations, and from 1e-3 on where neighbours move apart") {
  ThreadPool pool(2);
  const Vectors rest = rest_of("icosphere:5");
  for (const double tolerance : {3e-3, 1e-3, 3e-4}) {
    const ClusterSprings springs(rest, accuracy_of(tolerance));
    for (const Deformation& deformation : bench::deformations_of(rest)) {
      const bool is_smooth = deformation.name.starts_with("smooth") || deformation.name == "turned";
      const bool is_dephased = deformation.name == "dephased 0.008";
      if (!is_smooth && (!is_dephased || tolerance < 1e-3)) continue;
      CAPTURE(tolerance, deformation.name);
      const double error = error_of(springs.forces(pool, deformation.displacements), rest, deformation.displacements);
      CHECK(error < (is_smooth ? tolerance / 3 : tolerance));
      CHECK(error > tolerance / 30);  // which would be work for nothing
    }
  }
}

// A disc of 0.03 radii has clusters whose vertices spread little across it. Nodes that left that out would be off.
TEST_CASE("forces on a thin disc are as near") {
  ThreadPool pool(1);
  Vectors rest = rest_of("icosphere:4");
  for (glm::dvec3& p : rest) p.y *= 0.03;
  const ClusterSprings springs(rest, 1e-7);
  const Vectors displacements = bench::deformations_of(rest)[1].displacements;
  CHECK(error_of(springs.forces(pool, displacements), rest, displacements) < 5e-4);
}

TEST_CASE("the energy of a clustered body is near that of all springs") {
  ThreadPool pool(1);
  const Vectors rest = rest_of("icosphere:4");
  const ClusterSprings springs(rest, 1e-7);
  for (const Deformation& deformation : bench::deformations_of(rest)) {
    if (deformation.is_crushed) continue;
    CAPTURE(deformation.name);
    CHECK(springs.energy(pool, deformation.displacements) ==
          Approx(direct_energy(rest, deformation.displacements)).epsilon(1e-3));
  }
}

TEST_CASE("sums by clusters have the same bits on any number of threads") {
  const Vectors rest = rest_of("icosphere:4");
  const ClusterSprings springs(rest, 1e-7);
  const Vectors displacements = bench::deformations_of(rest)[2].displacements;
  ThreadPool one(1);
  for (const unsigned threads : {2u, 3u}) {
    ThreadPool pool(threads);
    CHECK(springs.energy(pool, displacements) == springs.energy(one, displacements));
    CHECK(springs.forces(pool, displacements) == springs.forces(one, displacements));
  }
}

TEST_CASE("bodies that are flat, thin or a point have clusters, too") {
  ThreadPool pool(1);
  for (const glm::dvec3& size : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 0)}) {
    Vectors rest = random_points(300, size);
    rest.insert(rest.end(), 50, rest[0]);  // several in one place
    const ClusterSprings springs(rest, 1e-7);
    Vectors displacements;
    for (const glm::dvec3& p : rest) displacements.push_back(0.1 * p * p);
    for (const glm::dvec3& force : springs.forces(pool, displacements)) CHECK(std::isfinite(glm::length(force)));
    CHECK(springs.energy(pool, displacements) == Approx(direct_energy(rest, displacements)).epsilon(1e-3));
  }
}

TEST_CASE("springs of a clustered body grow little faster than its vertices") {
  double before = 0;
  for (const char* mesh : {"icosphere:5", "icosphere:6"}) {
    const Vectors rest = rest_of(mesh);
    const double a_vertex = static_cast<double>(ClusterSprings(rest, 1e-7).counts().all()) / static_cast<double>(rest.size());
    if (before > 0) CHECK(a_vertex < 1.15 * before);  // N^1.1
    before = a_vertex;
  }
}

}  // namespace
}  // namespace pliant
