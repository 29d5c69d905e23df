#define REAL_BITS 64
// What one contact asks for, by physics/contact/contact.glsl: laws of one impact, and bounds that hold for any numbers.
#include "physics/contact/contact.glsl"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "collision/responses/impulse.hpp"

namespace pliant::physics64 {
namespace {

// Points that come at this velocity [m/s] towards each other and would pass the gap, with nothing that presses.
Course coming(double speed) { return {.distance = 0.02, .velocity = -speed, .surplus = 0, .was = -speed, .was_cut = false}; }

Approach of(double elasticity) { return {.gap = 0.01, .time_step = 0.01, .slowest = 0.01, .elasticity = elasticity}; }

TEST_CASE("a contact alone parts at the elasticity's part of its approach") {
  for (const double elasticity : {0.0, 0.3, 1.0}) {
    CAPTURE(elasticity);
    const Approach a = of(elasticity);
    const Course c = coming(5);
    const double mass = 2, change = least_velocity(c, a) - c.velocity;
    const glm::dvec4 normal_row(0, 1, 0, change), goal_row(0);
    glm::dvec4 impulse = next_impulse(glm::dvec4(0), normal_row, goal_row, glm::dvec3(0), mass, 0);
    CHECK(c.velocity + impulse.x / mass == Approx(0).margin(1e-14));  // stopped
    impulse.x *= bounce_of(c, a);
    CHECK(c.velocity + impulse.x / mass == Approx(elasticity * 5));
    // The impulse is the least one from then on: the contact takes none of it back.
    CHECK(next_impulse(impulse, normal_row, goal_row, {0, impulse.x / mass, 0}, mass, impulse.x) == impulse);
  }
}

TEST_CASE("points bounce by no less than what stops them, and by no more than that and the elasticity's part of it") {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int bounced = 0;
  for (int k = 0; k < 100000; ++k) {
    const double size = std::pow(10, between(-9, 9));
    const Course c{.distance = between(-0.01, 0.03),
                   .velocity = size * between(-1, 1),
                   .surplus = size * between(-1, 1),
                   .was = size * between(-1, 1),
                   .was_cut = between(0, 1) < 0.1};
    const Approach a = of(between(0, 1));
    const double factor = bounce_of(c, a);
    CAPTURE(c.distance, c.velocity, c.surplus, c.was, c.was_cut, a.elasticity);
    REQUIRE(factor >= 1);
    REQUIRE(factor <= 1 + a.elasticity);
    if (c.velocity >= 0 || rests(c)) REQUIRE(factor == 1);
    bounced += factor > 1 ? 1 : 0;
  }
  CHECK(bounced > 1000);
}

TEST_CASE("an impulse never pulls, and friction lies across the normal and within its bound") {
  std::mt19937 random(2);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto any = [&] { return glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)); };
  int slides = 0, sticks = 0;
  for (int k = 0; k < 100000; ++k) {
    const glm::dvec3 normal = glm::normalize(any());
    const double friction = between(0, 2), least = between(0, 0.2);
    const glm::dvec4 next = next_impulse(glm::dvec4(between(0, 1), across(normal, any())), glm::dvec4(normal, between(-1, 1)),
                                         glm::dvec4(across(normal, any()), friction), any(), between(0.1, 1), least);
    const glm::dvec3 sideways(next.y, next.z, next.w);
    REQUIRE(next.x >= least);
    REQUIRE(std::abs(glm::dot(sideways, normal)) < 1e-14);
    REQUIRE(glm::length(sideways) <= (1 + 1e-14) * friction * next.x);
    (glm::length(sideways) < 0.999 * friction * next.x ? sticks : slides) += 1;
  }
  CHECK(slides > 1000);
  CHECK(sticks > 1000);
}

}  // namespace
}  // namespace pliant::physics64
