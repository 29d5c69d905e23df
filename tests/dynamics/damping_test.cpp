// The shared damping formulas against the C library.
#include "physics/damping.glsl"

#include <catch2/catch.hpp>
#include <cmath>

namespace pliant {
namespace {

TEST_CASE("decay is e^-z and (1 - e^-z) / z from tiny to enormous z") {
  for (double z = 1e-300; z < 1e12; z *= 1.7) {
    CAPTURE(z);
    const physics::Decay d = physics::decay(z);
    CHECK(d.gain == Approx(-std::expm1(-z) / z).epsilon(1e-14));
    if (z < 700)
      CHECK(d.keep == Approx(std::exp(-z)).epsilon(1e-15 * std::max(10.0, 4 * z)));
    else
      CHECK(d.keep < 1e-300);
  }
}

TEST_CASE("decay is as good where its series gets shorter, and falls there, too") {
  constexpr double seam = 1.0 / 64;
  for (const double z : {std::nextafter(seam, 0.0), seam, std::nextafter(seam, 1.0)}) {
    const physics::Decay d = physics::decay(z);
    CHECK(d.gain == Approx(-std::expm1(-z) / z).epsilon(2e-16));
    CHECK(d.keep == Approx(std::exp(-z)).epsilon(2e-16));
  }
  CHECK(physics::decay(seam).gain >= physics::decay(std::nextafter(seam, 1.0)).gain);
  CHECK(physics::decay(seam).keep >= physics::decay(std::nextafter(seam, 1.0)).keep);
}

TEST_CASE("no damping keeps the velocity and the whole kick") {
  const physics::Decay d = physics::decay(0);
  CHECK(d.keep == 1);
  CHECK(d.gain == 1);
}

TEST_CASE("a kick back in time undoes the kick forward") {
  for (const double z : {1e-3, 0.2, 1.0, 5.0})
    CHECK(physics::decay(-z).keep * physics::decay(z).keep == Approx(1).epsilon(1e-13));
}

TEST_CASE("the adaptive law's rate grows with the force up to ten times c / m") {
  using namespace physics;
  CHECK(damping_rate(damping_none, 3, 0.5, 50 * 50) == 0);
  CHECK(damping_rate(damping_constant, 3, 0.5, 50 * 50) == 1.5);
  CHECK(damping_rate(damping_adaptive, 3, 0.5, 5 * 5) == Approx(0.75));
  CHECK(damping_rate(damping_adaptive, 3, 0.5, 1e18) == 15);
  CHECK(damping_rate(damping_adaptive, 3, 0.5, 0) == 0);
}

}  // namespace
}  // namespace pliant
