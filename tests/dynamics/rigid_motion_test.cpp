// The rigid motion of clouds of vertices, also of those that are a line or a point.
#include "physics/rigid_motion.glsl"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "support/evolve.hpp"

namespace pliant {
namespace {

using Vectors = std::vector<glm::dvec3>;

class Random {
 public:
  glm::dvec3 vector() { return {coordinate_(engine_), coordinate_(engine_), coordinate_(engine_)}; }
  glm::dvec3 direction() { return glm::normalize(vector()); }
  Vectors vectors(std::size_t count) {
    Vectors all(count);
    for (glm::dvec3& one : all) one = vector();
    return all;
  }

 private:
  std::mt19937 engine_{20240711};
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

Vectors rounded(Vectors places) {
  for (glm::dvec3& place : places) place = glm::dvec3(glm::vec3(place));
  return places;
}

Vectors turning(const Vectors& places, const glm::dvec3& velocity, const glm::dvec3& spin) {
  Vectors velocities;
  for (const glm::dvec3& place : places) velocities.push_back(velocity + glm::cross(spin, place));
  return velocities;
}

glm::dvec3 vector_of(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

physics::RigidMotion rigid_motion(const Vectors& places, const Vectors& velocities) {
  physics::Moments moments = physics::no_moments();
  for (std::size_t i = 0; i < places.size(); ++i)
    physics::add_vertex(moments, places[i] - places[0], velocities[i] - velocities[0]);
  return physics::rigid_motion_with(moments, static_cast<unsigned>(places.size()), places[0], velocities[0]);
}

// Returns what the rigid motion leaves of the velocities.
Vectors left_over(const Vectors& places, const Vectors& velocities) {
  const physics::RigidMotion motion = rigid_motion(places, velocities);
  Vectors left;
  for (std::size_t i = 0; i < places.size(); ++i)
    left.push_back(velocities[i] - vector_of(motion.velocity) -
                   glm::cross(vector_of(motion.spin), places[i] - vector_of(motion.centre)));
  return left;
}

double largest(const Vectors& vectors) {
  double most = 0;
  for (const glm::dvec3& one : vectors) most = larger(most, glm::length(one));
  return most;
}

TEST_CASE("a cloud that moves rigidly moves as its rigid motion, be it bulky, flat, a line, two vertices or one") {
  Random random;
  for (const glm::dvec3& shape :
       {glm::dvec3(1), glm::dvec3(1, 1e-3, 0.3), glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0)})
    for (const std::size_t count : {1, 2, 3, 40}) {
      CAPTURE(shape.x, shape.y, shape.z, count);
      Vectors places = random.vectors(count);
      const glm::dvec3 centre = random.vector();
      for (glm::dvec3& place : places) place = centre + shape * place;
      CHECK(largest(left_over(places, turning(places, random.vector(), random.vector()))) < 1e-8);
    }
}

TEST_CASE("what the rigid motion leaves has no momentum and no angular momentum") {
  Random random;
  for (const glm::dvec3& shape : {glm::dvec3(1), glm::dvec3(1, 1, 0), glm::dvec3(1, 1e-2, 1e-2), glm::dvec3(1, 0, 0)}) {
    CAPTURE(shape.x, shape.y, shape.z);
    Vectors places = random.vectors(30);
    for (glm::dvec3& place : places) place *= shape;
    const Vectors left = left_over(places, random.vectors(30));
    glm::dvec3 momentum(0.0), angular_momentum(0.0);
    for (std::size_t i = 0; i < left.size(); ++i) {
      momentum += left[i];
      angular_momentum += glm::cross(places[i], left[i]);
    }
    CHECK(glm::length(momentum) < 1e-13);
    CHECK(glm::length(angular_momentum) < 1e-10);
    CHECK(largest(left) > 0.1);
  }
}

TEST_CASE("a line in any direction does not spin about itself, also if its places are rounded to floats") {
  Random random;
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 along = random.direction(), centre = random.vector();
    Vectors places;
    for (int i = 0; i < 20; ++i) places.push_back(centre + (i / 10.0 - 1) * along);
    const Vectors velocities = turning(places, random.vector(), 3.0 * random.vector());
    for (const bool rounds : {false, true}) {
      CAPTURE(k, rounds);
      const Vectors at = rounds ? rounded(places) : places;
      CHECK(std::abs(glm::dot(vector_of(rigid_motion(at, velocities).spin), along)) < (rounds ? 1e-6 : 1e-13));
      CHECK(largest(left_over(at, velocities)) < (rounds ? 1e-6 : 1e-13));
    }
  }
}

TEST_CASE("vertices at one point have the mean velocity and no spin") {
  Random random;
  const Vectors places(10, random.vector()), velocities = random.vectors(10);
  const physics::RigidMotion motion = rigid_motion(places, velocities);
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& velocity : velocities) mean += velocity / 10.0;
  CHECK(glm::length(vector_of(motion.velocity) - mean) < 1e-15);
  CHECK(vector_of(motion.spin) == glm::dvec3(0.0));
}

}  // namespace
}  // namespace pliant
