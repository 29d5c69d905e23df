// Step bounds against published limits, and against oscillators that are really stepped.
#include "dynamics/stability.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <string>

#include "physics/damping.glsl"
#include "support/evolve.hpp"

namespace pliant {
namespace {

using Complex = std::complex<double>;

// One plain Runge-Kutta step of y' = lambda y from y = 1, with z = h lambda.
Complex plain_step(const RungeKutta& method, Complex z) {
  std::vector<Complex> slopes;
  Complex end = 1;
  for (int i = 0; i < method.stages; ++i) {
    Complex y = 1;
    for (int j = 0; j < i; ++j) y += static_cast<double>(method.a[i * method.stages + j]) * slopes[j];
    slopes.push_back(z * y);
    end += static_cast<double>(method.b[i]) * slopes[i];
  }
  return end;
}

// The larger amplification of the two solutions of x'' = -omega^2 x - g x'.
double oscillator_amplification(const RungeKutta& method, double h, double omega, double g) {
  const Complex root = std::sqrt(Complex(g * g / 4 - omega * omega));
  return larger(std::abs(plain_step(method, h * (-g / 2 + root))), std::abs(plain_step(method, h * (-g / 2 - root))));
}

// The growth of |(x, v)| per step over many steps of velocity Verlet with the damped kick. The equation is x'' = -x - g v.
double verlet_growth(double h, double g) {
  const double decay = std::exp(-g * h / 2), push = g > 0 ? (1 - decay) / g : h / 2;
  double x = 0.3, v = -0.4;
  constexpr int steps = 1000;
  for (int step = 0; step < steps; ++step) {
    v = decay * v - push * x;
    x += h * v;
    v = decay * v - push * x;
  }
  return std::pow(std::hypot(x, v) / 0.5, 1.0 / steps);
}

}  // namespace

TEST_CASE("undamped step bounds are the published limits of the imaginary axis") {
  // - rk4 to vern8: the largest y with |R(iy)| <= 1 + 1e-4, found on a grid of 6e-5 in exact coefficients
  // - verlet: closed form
  // - srkn11b: Blanes and Moan (2002)
  // - dprkn8, dprkn12: the first y at which a step's map, in exact coefficients, has an eigenvalue above 1 + 1e-4
  const std::pair<const char*, double> limits[] = {
      {"verlet", 2.0},     {"srkn11b", 3.1414},     {"rk4", 2.82852},   {"cv8", 3.00186},    {"cv8_minus", 3.39666},
      {"dop853", 5.96046}, {"verner78_8", 4.77546}, {"vern8", 2.85066}, {"dprkn8", 3.14028}, {"dprkn12", 8.32736}};
  REQUIRE(std::size(limits) == integrators().size());
  for (const auto& [name, limit] : limits) {
    CAPTURE(name);
    CHECK(step_bound(find_integrator(name), 1.0, 0.0) == Approx(limit).margin(1e-4));
  }
}

TEST_CASE("the stability polynomial is what a Runge-Kutta step does to an exponential") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    const std::vector<double> polynomial = stability_polynomial(*method);
    for (const Complex z : {Complex(0, 1.5), Complex(-2, 0), Complex(-0.8, 2.1), Complex(0.3, -0.2)}) {
      Complex value = 0;
      for (std::size_t k = polynomial.size(); k-- > 0;) value = value * z + polynomial[k];
      CHECK(std::abs(value - plain_step(*method, z)) < 1e-10);  // vern8 sums slopes 100 times the result
    }
  }
}

TEST_CASE("a method's polynomial agrees with the exponential series up to its order and no further") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    const std::vector<double> polynomial = stability_polynomial(*method);
    for (int k = 0; k <= integrator.order; ++k) CHECK(polynomial[k] == Approx(1 / std::tgamma(k + 1)).epsilon(1e-12));
    const double next = integrator.order + 1 < static_cast<int>(polynomial.size()) ? polynomial[integrator.order + 1] : 0;
    CHECK(next != Approx(1 / std::tgamma(integrator.order + 2)).epsilon(1e-3));
  }
}

TEST_CASE("a Runge-Kutta step within the bound does not amplify, and just beyond it does") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    for (const double largest_rate : {0.0, 0.3, 1.0, 2.0, 3.0, 40.0}) {
      CAPTURE(integrator.name, largest_rate);
      const double bound = step_bound(integrator, 1.0, largest_rate);
      double inside = 0, outside = 0;
      for (int i = 0; i <= 200; ++i) {
        const double rate = largest_rate * i / 200;
        for (const double part : {0.05, 0.3, 0.6, 0.9, 0.99})
          inside = larger(inside, oscillator_amplification(*method, part * bound, 1.0, rate));
        outside = std::max(outside, oscillator_amplification(*method, 1.002 * bound, 1.0, rate));
      }
      CHECK(inside <= 1 + 1e-4);
      CHECK(outside > 1 + 1e-4);
    }
  }
}

TEST_CASE("the amplification of an undamped oscillator is that of the stability polynomial, and settles the bound") {
  for (const Integrator& integrator : integrators()) {
    if (staged_method(integrator) == nullptr) continue;
    CAPTURE(integrator.name);
    const double bound = step_bound(integrator, 1.0, 0.0);
    for (const double part : {0.05, 0.3, 0.6, 0.9, 0.99}) CHECK(undamped_amplification(integrator, part * bound) <= 1 + 1e-4);
    CHECK(undamped_amplification(integrator, 1.0002 * bound) > 1 + 1e-4);
    if (const auto* method = std::get_if<RungeKutta>(&integrator.method))
      CHECK(undamped_amplification(integrator, 0.7) == Approx(oscillator_amplification(*method, 0.7, 1.0, 0.0)).epsilon(1e-12));
  }
}

TEST_CASE("slower modes bear the step of the stiffest and of free drift") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    for (const double largest_rate : {0.0, 0.3, 1.0, 1.9, 2.1, 3.0, 40.0}) {
      CAPTURE(integrator.name, largest_rate);
      const double h = 0.9 * std::min(step_bound(integrator, 1.0, largest_rate), step_bound(integrator, 0.0, largest_rate));
      double largest = 0;
      for (int i = 0; i <= 50; ++i)
        for (int j = 0; j <= 50; ++j)
          largest = larger(largest, oscillator_amplification(*method, h, i / 50.0, largest_rate * j / 50));
      CHECK(largest <= 1 + 1e-4);
    }
  }
}

TEST_CASE("a body drifting through a strongly damping medium bears less than its stiffest mode") {
  const Integrator& rk4 = find_integrator("rk4");
  CHECK(step_bound(rk4, 1.0, 1.9) > 2.5);
  CHECK(step_bound(rk4, 0.0, 1.9) == Approx(2.7853 / 1.9).epsilon(1e-3));  // the limit of the real axis
}

TEST_CASE("step bounds scale with the period") {
  for (const Integrator& integrator : integrators()) {
    CAPTURE(integrator.name);
    const double rate = allows_damping(integrator, DampingLaw::constant) ? 3.0 : 0.0;
    CHECK(step_bound(integrator, 4e4, 2 * rate) == Approx(step_bound(integrator, 1e4, rate) / 2).epsilon(1e-9));
  }
}

TEST_CASE("more damping never lengthens a Runge-Kutta method's bound") {
  for (const Integrator& integrator : integrators()) {
    if (!std::holds_alternative<RungeKutta>(integrator.method)) continue;
    double previous = step_bound(integrator, 1.0, 0.0);
    for (const double rate : {0.1, 0.7, 1.9, 2.0, 2.1, 5.0, 100.0}) {
      CAPTURE(integrator.name, rate);
      const double bound = step_bound(integrator, 1.0, rate);
      CHECK(bound <= previous * (1 + 2e-3));  // the bound samples angles
      previous = bound;
    }
  }
}

TEST_CASE("verlet bears any damping within its undamped bound") {
  const Integrator& verlet = find_integrator("verlet");
  for (const double rate : {0.0, 0.5, 3.0, 1e6}) {
    CAPTURE(rate);
    CHECK(step_bound(verlet, 1.0, rate) == Approx(2.0).margin(1e-6));
    CHECK(verlet_growth(1.98, rate) < 1 + 5e-3);
  }
  CHECK(verlet_growth(2.02, 0.0) > 1.05);
}

// The larger eigenvalue of a step on x'' = -omega^2 x - g v. The step's length is h = omega_step / omega, and drag is g h.
double damped_amplification(const Integrator& integrator, double omega_step, double drag) {
  const NystromTableau tableau = nystrom_tableau(integrator, Stages::of_result, drag);
  std::complex<double> map[2][2];  // [to][from] of x and h v
  for (int from = 0; from < 2; ++from) {
    const double x = from == 0, v = from == 1;
    std::vector<double> accelerations;
    double end_x = 0, end_v = 0;
    for (int row = 0; row <= tableau.stages; ++row) {
      end_x = x + tableau.c[row] * v;
      end_v = tableau.keep[row] * v;
      for (std::size_t j = 0; j < accelerations.size(); ++j) {
        end_x += tableau.position[row * tableau.stages + j] * accelerations[j];
        end_v += tableau.velocity[row * tableau.stages + j] * accelerations[j];
      }
      accelerations.push_back(-omega_step * omega_step * end_x);
    }
    map[0][from] = end_x;
    map[1][from] = end_v;
  }
  const auto half_trace = (map[0][0] + map[1][1]) / 2.0;
  const auto root = std::sqrt(half_trace * half_trace - (map[0][0] * map[1][1] - map[0][1] * map[1][0]));
  return larger(std::abs(half_trace + root), std::abs(half_trace - root));
}

TEST_CASE("Nystrom methods bear any rate of damping within their undamped bound, and drift as drag lets them within drag's") {
  for (const Integrator& integrator : integrators()) {
    if (!std::holds_alternative<Nystrom>(integrator.method)) continue;
    const double bound = step_bound(integrator, 1.0, 0.0);
    for (const double drag : {1e-3, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 100.0, 1e4})
      for (int i = 0; i <= 100; ++i) {
        CAPTURE(integrator.name, drag, i);
        CHECK(damped_amplification(integrator, bound * i / 100, drag) <= 1 + 1e-4);
      }
    ModelBody body{};
    body.vertex_mass = body.damping = 1;
    const double longest = drag_bound(integrator, body, DampingLaw::constant);
    CHECK(std::isinf(drag_bound(integrator, body, DampingLaw::none)));
    CHECK(longest > 3);
    for (const double part : {0.01, 0.5, 0.99, 1.05}) {
      CAPTURE(integrator.name, part);
      const double drag = part * longest;
      const NystromTableau tableau = nystrom_tableau(integrator, Stages::of_result, drag);
      double fallen = 0;
      for (int j = 0; j < tableau.stages; ++j) fallen += drag * drag * tableau.position[tableau.stages * tableau.stages + j];
      const double lost = 1 - std::exp(-drag), drift = std::abs(drag * tableau.c.back() - lost),
                   fall = std::abs(fallen - drag + lost);
      CHECK((larger(drift, fall) <= 1e-4) == (part < 1));
    }
  }
}

TEST_CASE("the largest damping rate is the one that the law reaches at the strongest force") {
  ModelBody body;
  body.damping = 3;
  body.vertex_mass = 2;
  for (const auto& [law, number] :
       {std::pair(DampingLaw::constant, physics::damping_constant), std::pair(DampingLaw::adaptive, physics::damping_adaptive),
        std::pair(DampingLaw::internal, physics::damping_constant)})
    CHECK(largest_damping_rate(body, law) == Approx(physics::damping_rate(number, 3, 0.5, 1e12)));
  CHECK(largest_damping_rate(body, DampingLaw::none) == 0);
}

TEST_CASE("without springs only damping bounds the step") {
  for (const Integrator& integrator : integrators()) {
    CAPTURE(integrator.name);
    CHECK(std::isinf(step_bound(integrator, 0.0, 0.0)));
    if (!allows_damping(integrator, DampingLaw::constant)) continue;
    CHECK(std::isinf(step_bound(integrator, 0.0, 5.0)) == !std::holds_alternative<RungeKutta>(integrator.method));
  }
}

}  // namespace pliant
