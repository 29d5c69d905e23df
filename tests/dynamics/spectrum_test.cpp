// The eigenvalues of the network's stiffness matrix, on which the automatic step rests.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#define REAL_BITS 64
#include "physics/forces/spring.glsl"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// d(force on i) / d(position of j) of springs with k = 1 about the rest shape, by central differences.
Eigen::MatrixXd stiffness_matrix(const Model& model) {
  const auto count = static_cast<Eigen::Index>(model.rest_positions.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  const double step = 1e-5;
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      for (int axis = 0; axis < 3; ++axis) {
        if (i == j) continue;
        const glm::dvec3 rest = glm::dvec3(model.rest_positions[static_cast<std::size_t>(i)]) -
                                glm::dvec3(model.rest_positions[static_cast<std::size_t>(j)]);
        glm::dvec3 move(0.0);
        move[axis] = step;
        const auto elongation = [&](const glm::dvec3& d) { return physics64::spring_strain(rest + d, d) * (rest + d); };
        const glm::dvec3 change = (elongation(move) - elongation(-move)) / (2 * step);
        for (int k = 0; k < 3; ++k) {
          matrix(3 * i + k, 3 * i + axis) += change[k];
          matrix(3 * i + k, 3 * j + axis) -= change[k];
        }
      }
  return matrix;
}

TEST_CASE("the stiffest mode has eigenvalue N k, and only the six rigid motions have zero") {
  for (const int level : {0, 1}) {
    const Model model = built(sphere(level)).model;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness_matrix(model)).eigenvalues();
    const double count = model.vertex_count();
    CAPTURE(count);
    CHECK(values(values.size() - 1) == Approx(count).epsilon(1e-6));
    for (Eigen::Index rigid = 0; rigid < 6; ++rigid) CHECK(std::abs(values(rigid)) < 1e-5);
    CHECK(values(6) > 0.1 * count);
  }
}

}  // namespace
}  // namespace pliant
