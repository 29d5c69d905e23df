// How motions are expected decides whether contacts give energy. The oracle is a body of two parts that swing against each other,
// of which the ground holds one.
#include "physics/contact/surplus.glsl"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "collision/responses/impulse.hpp"

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

struct Foreseen {
  Body (*move)(Body, double);
  Foresight foresight;
};
constexpr Foreseen springs = {moved_exactly, foresight_of_most_methods},
                   verlet = {moved_by_verlet, foresight_with_forces_at_ends};

Surplus after(const Surplus& before, double s, double e, double longer, const Foresight& foresight) {
  return physics::surplus_after(s, e, physics::in_longer_steps(before, longer), longer, foresight.share_of_end,
                                foresight.share_of_lead);
}

// Returns by how much the free part's largest speed grows from the first to the last hundred of 20,000 steps. Every fourth one
// has the length `rest`, as where a frame ends.
double growth(const Foreseen& how, double held_mass, double length, double rest = 0) {
  Body body = {{{held_mass, 0, 0}, {1 - held_mass, 1, 0}}};
  Surplus surplus{};
  double first = 0, last = 0, length_before = length;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double step_length = rest > 0 && k % 4 == 3 ? rest : length, longer = step_length / length_before;
    length_before = step_length;
    body[0].velocity = -longer * surplus.expected;  // what makes the mean velocity zero, as far as it is foreseen
    const Body before = body;
    body = how.move(body, step_length);
    const double mean = (body[0].place - before[0].place) / step_length;
    surplus = after(surplus, mean - before[0].velocity, body[0].velocity - mean, longer, how.foresight);
    if (k < 100) first = std::max(first, std::abs(body[1].velocity));
    if (k >= steps - 100) last = std::max(last, std::abs(body[1].velocity));
  }
  return last / first - 1;
}

TEST_CASE("a body that is held on a ground gains no energy from how its motion is expected") {
  for (const double held_mass : {0.02, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.98}) {
    for (const double step_omega : {0.1, 0.3, 0.5, 0.7, 0.75}) {
      CAPTURE(held_mass, step_omega);
      CHECK(growth(springs, held_mass, step_omega) < 0.01);
    }
    for (const double step_omega : {0.1, 0.5, 0.8, 1.2, 1.8}) {
      CAPTURE(held_mass, step_omega);
      CHECK(growth(verlet, held_mass, step_omega) < 0.01);
    }
  }
  CHECK(growth({moved_exactly, {1, 0}}, 0.49, 0.5) > 1);  // what else they would gain
}

TEST_CASE("where nothing changes the last step is expected to repeat, whatever damping takes") {
  for (const Foresight& foresight : {foresight_of_most_methods, foresight_with_forces_at_ends}) {
    Surplus known = after({}, 0.5, 0.3, 1, foresight);
    CHECK(known.expected == 0.3);
    for (int k = 0; k < 2; ++k) known = after(known, 0.5, 0.3, 1, foresight);
    CHECK(known.expected == 0.5);
  }
}

TEST_CASE("steps of other lengths in between give no energy to speak of") {
  for (const double held_mass : {0.1, 0.5, 0.8})
    for (const double rest : {1e-6, 0.01, 0.4}) {
      CAPTURE(held_mass, rest);
      CHECK(growth(springs, held_mass, 0.6, rest) < 0.5);
      CHECK(growth(verlet, held_mass, 0.6, rest) < 0.5);
    }
}

}  // namespace
}  // namespace pliant
