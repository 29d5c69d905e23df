// What the tests of the writers write: a small model.
#pragma once
#include <random>
#include <vector>

#include "model/model.hpp"

namespace pliant::test {

/// A tetrahedron and a triangle. What the files hold comes from the arguments of the writers.
inline Model two_bodies() {
  Model model;
  model.bodies.resize(2);
  model.bodies[0].name = "left";
  model.bodies[0].vertex_count = 4;
  model.bodies[0].triangle_count = 4;
  model.bodies[0].color = {1.0, 0.5, 0.0};
  model.bodies[1].name = "right\nv 0 0 0";  // a name that tries to be a vertex
  model.bodies[1].first_vertex = 4;
  model.bodies[1].vertex_count = 3;
  model.bodies[1].first_triangle = 4;
  model.bodies[1].triangle_count = 1;
  model.rest_positions.resize(7);
  model.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {4, 5, 6}};
  return model;
}

inline std::vector<glm::dvec3> some_vectors(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-10.0, 10.0);
  std::vector<glm::dvec3> vectors(7);
  for (glm::dvec3& vector : vectors) vector = {number(random), number(random), number(random)};
  return vectors;
}

}  // namespace pliant::test
