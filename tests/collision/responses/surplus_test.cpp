// How motions are expected decides whether contacts give energy. The oracle is a body of two parts that swing against each other,
// of which the ground holds one.
#include "physics/contact/surplus.glsl"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

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

Surplus after(const Surplus& before, double s, double e, double length, double last_length, const Foresight& foresight) {
  if (!physics::tells_of_surplus(length, last_length)) return before;
  return physics::surplus_after(s, e, before, length, foresight.share_of_end, foresight.share_of_lead);
}

// Returns how many times as large the free part's largest speed is in the last hundred of 20,000 steps as in the first hundred.
// `lengths` are those of the steps, one after another and again.
double growth(const Foreseen& how, double held_mass, const std::vector<double>& lengths) {
  Body body = {{{held_mass, 0, 0}, {1 - held_mass, 1, 0}}};
  Surplus surplus{};
  double first = 0, last = 0, last_length = 0;
  constexpr std::size_t steps = 20000;
  for (std::size_t k = 0; k < steps; ++k) {
    const double length = lengths[k % lengths.size()];
    body[0].velocity = -length * surplus.expected;  // what makes the mean velocity zero, as far as it is foreseen
    const Body before = body;
    body = how.move(body, length);
    const double mean = (body[0].place - before[0].place) / length;
    surplus = after(surplus, mean - before[0].velocity, body[0].velocity - mean, length, std::exchange(last_length, length),
                    how.foresight);
    if (k < 100) first = std::max(first, std::abs(body[1].velocity));
    if (k >= steps - 100) last = std::max(last, std::abs(body[1].velocity));
  }
  return last / first;
}

// Returns the growth over all these steps if each adds this part.
double in_all_steps(double a_step) { return std::exp(19900 * a_step); }

constexpr std::array held_masses = {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.96, 0.98};

TEST_CASE("the swing of a held body does not grow in steps of up to 0.75 / omega, and by 1e-4 a step at most at 0.8") {
  for (const double held_mass : held_masses) {
    for (const double length : {0.1, 0.3, 0.5, 0.7, 0.75}) {
      CAPTURE(held_mass, length);
      CHECK(growth(springs, held_mass, {length}) < 1.01);
    }
    for (const double length : {0.1, 0.5, 0.8, 1.2, 1.8}) {
      CAPTURE(held_mass, length);
      CHECK(growth(verlet, held_mass, {length}) < 1.01);
    }
    CHECK(growth(springs, held_mass, {0.8}) < in_all_steps(1e-4));  // the longest that contacts take
  }
  // what others would gain
  CHECK(growth({moved_exactly, {1, 0}}, 0.49, {0.5}) > in_all_steps(1e-3));
  CHECK(growth({moved_by_verlet, {1.5, 0}}, 0.5, {0.5}) > in_all_steps(1e-3));
}

TEST_CASE("one short step among long ones makes no swing grow, and two in a row by 0.25 % a step at most") {
  for (const double held_mass : held_masses)
    for (const double shorter : {1e-6, 0.9e-3, 1.1e-3, 0.05, 0.1, 0.15, 0.2, 0.25, 0.4, 0.7, 0.9}) {
      CAPTURE(held_mass, shorter);
      const double l = 0.75, s = shorter * l;
      CHECK(growth(springs, held_mass, {l, s}) < 1.01);
      CHECK(growth(springs, held_mass, {l, l, s}) < 1.01);
      CHECK(growth(springs, held_mass, {l, l, l, s}) < 1.01);
      CHECK(growth(springs, held_mass, {l, l, s, s}) < in_all_steps(2.5e-3));
      CHECK(growth(springs, held_mass, {l, l, l, s, s}) < in_all_steps(2.5e-3));
      CHECK(growth(verlet, held_mass, {0.5, 0.5, 0.5, shorter * 0.5}) < 1.01);
      CHECK(growth(verlet, held_mass, {0.5, 0.5, shorter * 0.5, shorter * 0.5}) < 1.01);
    }
}

TEST_CASE("a smooth motion is foreseen to the first order, whatever lengths steps have") {
  const std::vector<std::vector<double>> ways = {
      {1}, {1, 0.5}, {1, 1, 1, 1e-6}, {1, 1, 1, 0.06, 0.06, 0.5, 0.5}, {1, 1.1e-3, 1.1e-3}};
  for (const Foresight& foresight : {foresight_of_most_methods, foresight_with_forces_at_ends})
    for (const auto& way : ways)
      for (const double longest : {0.01, 0.3}) {
        CAPTURE(foresight.share_of_end, way, longest);
        Surplus surplus{};
        double time = 0, last_length = 0;
        for (std::size_t k = 0; k < 200; ++k) {  // x = cos(t)
          const double length = longest * way[k % way.size()];
          const double exact_mean = -2 * std::sin(time + length / 2) * std::sin(length / 2) / length;
          if (k > 0) CHECK(std::abs(length * surplus.expected - (exact_mean + std::sin(time))) < longest * length);
          const double mean = (std::cos(time + length) - std::cos(time)) / length;  // with the roundings of places
          surplus = after(surplus, mean + std::sin(time), -std::sin(time + length) - mean, length,
                          std::exchange(last_length, length), foresight);
          time += length;
        }
      }
}

TEST_CASE("where nothing changes the last step is expected to repeat, whatever damping takes") {
  for (const Foresight& foresight : {foresight_of_most_methods, foresight_with_forces_at_ends}) {
    Surplus known{};
    double last_length = 0;
    for (const double length : {1.0, 1.0, 0.25, 1e-6, 1.0, 0.5}) {
      const bool is_first = known.of_end == 0;
      known = after(known, 0.5 * length, 0.3 * length, length, std::exchange(last_length, length), foresight);
      CHECK(known.expected == Approx(is_first ? 0.3 : 0.5).epsilon(1e-12));
    }
  }
}

TEST_CASE("a step of less than a thousandth of the last one's length changes nothing, and one more does") {
  Surplus known{};
  for (int k = 0; k < 3; ++k) known = after(known, 0.5, 0.3, 1, 1, foresight_of_most_methods);
  const Surplus then = after(known, 9, 7, 0.9e-3, 1, foresight_of_most_methods);
  CHECK(std::array{then.expected, then.of_end, then.lead} == std::array{known.expected, known.of_end, known.lead});
  CHECK(after(then, 9, 7, 0.9e-3, 0.9e-3, foresight_of_most_methods).expected != known.expected);
}

}  // namespace
}  // namespace pliant
