// How motions are expected decides whether contacts give energy. The oracle is a body of two parts that swing against each other,
// of which the ground holds one.
#include "physics/contact/surplus.glsl"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

namespace pliant {
namespace {

using physics::Surplus;

struct Part {
  double mass, place, velocity;
};
using Body = std::array<Part, 2>;  // the first one is held

// Each part feels an acceleration of -(place - centre), so that omega is 1.
struct Relative {
  explicit Relative(const Body& body)
      : centre(body[0].mass * body[0].place + body[1].mass * body[1].place),
        drift(body[0].mass * body[0].velocity + body[1].mass * body[1].velocity) {}
  double centre, drift;
};

Body moved_exactly(Body body, double length) {
  const Relative about(body);
  for (Part& part : body) {
    const double place = part.place - about.centre, velocity = part.velocity - about.drift;
    part.place = about.centre + length * about.drift + place * std::cos(length) + velocity * std::sin(length);
    part.velocity = about.drift - place * std::sin(length) + velocity * std::cos(length);
  }
  return body;
}

void kick(Body& body, double time) {
  const double centre = Relative(body).centre;
  for (Part& part : body) part.velocity -= time * (part.place - centre);
}

Body moved_by_verlet(Body body, double length) {
  kick(body, length / 2);
  for (Part& part : body) part.place += length * part.velocity;
  kick(body, length / 2);
  return body;
}

// Returns by how much the free part's largest speed grows from the first to the last hundred of 20,000 steps. Every fourth one
// has the length `rest`, as where a frame ends.
double growth(Body (*move)(Body, double), double held_mass, double length, double share, double rest = 0) {
  Body body = {{{held_mass, 0, 0}, {1 - held_mass, 1, 0}}};
  Surplus surplus{};
  double first = 0, last = 0, length_before = length;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double step_length = rest > 0 && k % 4 == 3 ? rest : length, longer = step_length / length_before;
    length_before = step_length;
    body[0].velocity = -longer * surplus.expected;  // what makes the mean velocity zero, as far as it is foreseen
    const Body before = body;
    body = move(body, step_length);
    const double mean = (body[0].place - before[0].place) / step_length;
    surplus = physics::surplus_after(mean - before[0].velocity, body[0].velocity - mean,
                                     physics::in_longer_steps(surplus, longer), longer, share);
    if (k < 100) first = std::max(first, std::abs(body[1].velocity));
    if (k >= steps - 100) last = std::max(last, std::abs(body[1].velocity));
  }
  return last / first - 1;
}

TEST_CASE("a body that is held on a ground gains no energy from how its motion is expected") {
  for (const double held_mass : {0.02, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.98}) {
    for (const double step_omega : {0.1, 0.3, 0.5, 0.7, 0.75}) {
      CAPTURE(held_mass, step_omega);
      CHECK(growth(moved_exactly, held_mass, step_omega, 0.6) < 0.01);
    }
    for (const double step_omega : {0.1, 0.5, 0.8, 1.2, 1.8}) {
      CAPTURE(held_mass, step_omega);
      CHECK(growth(moved_by_verlet, held_mass, step_omega, 1) < 0.01);
    }
  }
  CHECK(growth(moved_exactly, 0.49, 0.5, 1) > 1);  // what else they would gain
}

TEST_CASE("where nothing changes the last step is expected to repeat, whatever damping takes") {
  Surplus known = physics::surplus_after(0.5, 0.3, Surplus{}, 1, 0.6);
  CHECK(known.expected == 0.3);
  known = physics::surplus_after(0.5, 0.3, known, 1, 0.6);
  known = physics::surplus_after(0.5, 0.3, known, 1, 0.6);
  CHECK(known.expected == 0.5);
}

TEST_CASE("steps of other lengths in between give no energy to speak of") {
  for (const double held_mass : {0.1, 0.5, 0.8})
    for (const double rest : {1e-6, 0.01, 0.4}) {
      CAPTURE(held_mass, rest);
      CHECK(growth(moved_exactly, held_mass, 0.6, 0.6, rest) < 0.5);
      CHECK(growth(moved_by_verlet, held_mass, 0.6, 1, rest) < 1);  // 4e-5 a step
    }
}

TEST_CASE("what Verlet's method does is foreseen") {
  Body body = {{{0.3, 0, 0}, {0.7, 0, 0}}};  // undeformed, until it is hit
  Surplus surplus{};
  for (int k = 0; k < 20; ++k) {
    if (k == 3) body[1].velocity = 0.4;
    const Body before = body;
    body = moved_by_verlet(body, 1.5);
    const double mean = (body[0].place - before[0].place) / 1.5;
    CHECK(mean == Approx(before[0].velocity + surplus.expected).margin(1e-13));
    surplus = physics::surplus_after(mean - before[0].velocity, body[0].velocity - mean, surplus, 1, 1);
  }
}

}  // namespace
}  // namespace pliant
