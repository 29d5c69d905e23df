// Proofs that moving triangles stay apart, against motions whose answer is known by how they were made.
#define REAL_BITS 64
#include "physics/contact/separation.glsl"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace pliant {
namespace {

using physics64::Motion;

class Random {
 public:
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  glm::dvec3 point() { return {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)}; }
  glm::dvec3 direction() {
    glm::dvec3 p = point();
    while (glm::length(p) > 1 || glm::length(p) < 0.1) p = point();
    return glm::normalize(p);
  }

 private:
  std::mt19937_64 engine_{20261123};
};

// A point on this side of the plane through the origin, no nearer to it than `gap`.
glm::dvec3 point_above(Random& random, const glm::dvec3& normal, double gap) {
  const glm::dvec3 p = random.point();
  return p + (gap + std::pow(10, random(-6, 0)) - glm::dot(p, normal)) * normal;
}

// Both triangles go anywhere, each on its side of a plane.
Motion on_two_sides(Random& random, double gap) {
  const glm::dvec3 normal = random.direction();
  Motion motion;
  motion.margin = 1e-12;
  for (int k = 0; k < 6; ++k) {
    const glm::dvec3 side = k < 3 ? normal : -normal;
    motion.start[k] = point_above(random, side, gap);
    motion.end[k] = point_above(random, side, gap);
  }
  return motion;
}

// A corner goes through a triangle that stands.
Motion through(Random& random) {
  Motion motion;
  motion.margin = 1e-12;
  const std::array<glm::dvec3, 3> corners = {random.point(), random.point(), random.point()};
  for (int k = 0; k < 3; ++k) motion.start[k] = motion.end[k] = corners[static_cast<std::size_t>(k)];
  const double a = random(0.1, 0.4), b = random(0.1, 0.4);
  const glm::dvec3 inside = (1 - a - b) * corners[0] + a * corners[1] + b * corners[2];
  const glm::dvec3 side = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])), way = random.direction();
  const glm::dvec3 across = glm::dot(way, side) < 0 ? -way : way;
  for (int k = 3; k < 6; ++k) {
    const glm::dvec3 behind = k == 3 ? glm::dvec3(0) : 0.5 * point_above(random, side, 0.1);
    motion.start[k] = inside + 0.3 * across + behind;
    motion.end[k] = inside - 0.3 * across + behind;
  }
  return motion;
}

TEST_CASE("of triangles that stay on two sides of a plane this is proven, however near they are") {
  Random random;
  for (const double gap : {0.3, 1e-2, 1e-4, 1e-6}) {
    int proven = 0;
    for (int i = 0; i < 5000; ++i) proven += physics64::stays_apart(on_two_sides(random, gap)) ? 1 : 0;
    CAPTURE(gap);
    CHECK(proven == 5000);
  }
}

TEST_CASE("of a corner that goes through a triangle nothing is proven") {
  Random random;
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(physics64::stays_apart(through(random)));
}

}  // namespace
}  // namespace pliant
