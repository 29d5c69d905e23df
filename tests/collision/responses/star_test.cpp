// Facets of stars that move: what is proven of them holds at every time, and facets that hardly move are proven.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <utility>

#define REAL_BITS 32
#include "physics/contact/star.glsl"

namespace pliant::physics32 {
namespace {

std::mt19937 engine(20261127);

float number(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine); }
glm::vec3 point() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }

// A triangle around a direction, wound counter-clockwise seen from outside. Each corner goes by up to `way` along each axis [m].
Facet moving_facet(float way) {
  Facet f;
  do
    for (auto& corner : f.start) corner = point();
  while (triple_product(f.start[0], f.start[1], f.start[2]) < 0.02f);
  for (int k = 0; k < 3; ++k) f.end[k] = f.start[k] + way * point();
  return f;
}

double volume_at(const Facet& f, double time) {
  glm::dvec3 p[3];
  for (int k = 0; k < 3; ++k) p[k] = (1 - time) * glm::dvec3(f.start[k]) + time * glm::dvec3(f.end[k]);
  return glm::dot(p[0], glm::cross(p[1], p[2]));
}

double least_volume(const Facet& f) {
  double least = volume_at(f, 0);
  for (int n = 1; n <= 200; ++n) least = std::min(least, volume_at(f, n / 200.0));
  return least;
}

Facet wound_the_other_way(Facet f) {
  std::swap(f.start[1], f.start[2]);
  std::swap(f.end[1], f.end[2]);
  return f;
}

TEST_CASE("a facet that is proven to face out does so at every time, and one that hardly moves is proven") {
  for (const float way : {0.001f, 0.1f, 0.5f, 2.0f}) {
    int proven = 0, inward = 0;
    for (int i = 0; i < 4000; ++i) {
      const Facet f = moving_facet(way);
      const bool faces = faces_out(f, 1, 0);
      CHECK(faces_out(wound_the_other_way(f), -1, 0) == faces);
      CHECK_FALSE((faces && !(least_volume(f) > 0)));
      CHECK_FALSE((faces && faces_out(f, -1, 0)));
      proven += faces ? 1 : 0;
      inward += least_volume(f) <= 0 ? 1 : 0;
    }
    CAPTURE(way, proven, inward);
    if (way == 0.001f) CHECK(proven == 4000);
    if (way >= 0.5f) CHECK(inward > 100);
  }
}

TEST_CASE("a facet whose volume rounding in the world could turn round is not proven") {
  const Facet f = moving_facet(0);
  CHECK(faces_out(f, 1, 0));
  CHECK_FALSE(faces_out(f, 1, 1));
}

TEST_CASE("the depth below a facet's plane is the distance from it") {
  const glm::vec3 a(0, 0, 2), b(1, 0, 2), c(0, 1, 2);
  CHECK(is_deep_below(a, b, c, 1, 1.999f));
  CHECK_FALSE(is_deep_below(a, b, c, 1, 2.001f));
  CHECK_FALSE(is_deep_below(a, b, c, -1, 0));
  CHECK(is_deep_below(a, c, b, -1, 1.999f));
}

}  // namespace
}  // namespace pliant::physics32
