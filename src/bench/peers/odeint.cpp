// Runs Boost.odeint's methods: Runge-Kutta, also with pliant's coefficients of Vern8, extrapolation, Adams and a symplectic one.
#include "bench/peers/peers.hpp"

#ifdef PLIANT_ODEINT
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <functional>
#include <utility>

#include "core/expect.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_ODEINT
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

auto rates_of(PeerSystem& system) {
  return [&system](const Numbers& y, Numbers& rates, double) { system.rates(y.data(), rates.data()); };
}

// Numbers of stages that the result needs, and that the estimate needs.
constexpr std::size_t vern8_stages = 12, vern8_estimate_stages = 13;
using Vern8 = odeint::explicit_generic_rk<vern8_stages, 8, Numbers>;
using Vern8WithEstimate = odeint::explicit_error_generic_rk<vern8_estimate_stages, 8, 8, 7, Numbers>;

const RungeKutta& pliants_vern8() { return std::get<RungeKutta>(find_integrator("vern8").method); }

template <std::size_t count>
boost::array<double, count> rounded(const std::vector<long double>& values, std::size_t first = 0) {
  boost::array<double, count> result;
  std::transform(values.begin() + first, values.begin() + first + count, result.begin(),
                 [](long double value) { return static_cast<double>(value); });
  return result;
}

// Returns the rows of A below its first. Each is as long as its number.
template <class Method, std::size_t... row>
typename Method::coef_a_type rows_of(const RungeKutta& method, std::index_sequence<row...>) {
  return typename Method::coef_a_type(rounded<row + 1>(method.a, (row + 1) * static_cast<std::size_t>(method.stages))...);
}

Vern8 vern8() {
  const RungeKutta& method = pliants_vern8();
  PLIANT_EXPECT(evaluations_per_step(find_integrator("vern8")) == vern8_stages);
  return {rows_of<Vern8>(method, std::make_index_sequence<vern8_stages - 1>()), rounded<vern8_stages>(method.b),
          rounded<vern8_stages>(method.c)};
}

Vern8WithEstimate vern8_with_estimate() {
  const RungeKutta& method = pliants_vern8();
  PLIANT_EXPECT(method.stages == vern8_estimate_stages);
  const auto b = rounded<vern8_estimate_stages>(method.b);
  auto difference = rounded<vern8_estimate_stages>(method.b_hat);
  std::transform(b.begin(), b.end(), difference.begin(), difference.begin(), std::minus());
  return {rows_of<Vern8WithEstimate>(method, std::make_index_sequence<vern8_estimate_stages - 1>()), b, difference,
          rounded<vern8_estimate_stages>(method.c)};
}

double take_fixed_steps(auto method, PeerSystem& system, Numbers& state, double duration, double effort) {
  const auto steps = static_cast<std::size_t>(std::llround(effort));
  const double step = duration / static_cast<double>(steps);
  Stopwatch watch;
  watch.time([&] { odeint::integrate_n_steps(method, rates_of(system), state, 0.0, step, steps); });
  return watch.seconds();
}

double take_adaptive_steps(auto method, PeerSystem& system, Numbers& state, double duration) {
  Stopwatch watch;
  watch.time([&] { odeint::integrate_adaptive(method, rates_of(system), state, 0.0, duration, 0.1 / system.omega()); });
  return watch.seconds();
}

template <class Method>
double control(const Method& method, PeerSystem& system, Numbers& state, double duration, double effort) {
  using Control = odeint::controlled_runge_kutta<Method>;
  using Checker = typename Control::error_checker_type;
  using Adjuster = typename Control::step_adjuster_type;
  return take_adaptive_steps(Control(Checker(effort * size_of_numbers(state), effort), Adjuster(), method), system, state,
                             duration);
}

double extrapolate(PeerSystem& system, Numbers& state, double duration, double effort) {
  return take_adaptive_steps(odeint::bulirsch_stoer<Numbers>(effort * size_of_numbers(state), effort), system, state, duration);
}

// A Runge-Kutta method of its own order makes the first steps.
double take_adams_steps(PeerSystem& system, Numbers& state, double duration, double effort) {
  constexpr std::size_t order = 8;
  const auto steps = static_cast<std::size_t>(std::llround(effort));
  const double step = duration / static_cast<double>(steps);
  odeint::adams_bashforth_moulton<order, Numbers> method;
  const auto rates = rates_of(system);
  Stopwatch watch;
  watch.time([&] {
    double time = 0;
    method.initialize(odeint::runge_kutta_fehlberg78<Numbers>(), rates, state, time, step);  // takes order - 1 steps
    for (std::size_t k = order - 1; k < steps; ++k, time += step) method.do_step(rates, state, time, step);
  });
  return watch.seconds();
}

double compose(PeerSystem& system, Numbers& state, double duration, double effort) {
  const auto steps = static_cast<std::size_t>(std::llround(effort));
  const double scaled_step = system.omega() * duration / static_cast<double>(steps);  // dq/dt = p wants time in radians
  const auto middle = state.begin() + static_cast<std::ptrdiff_t>(state.size() / 2);
  Numbers displacements(state.begin(), middle), velocities(middle, state.end());
  const auto accelerations = [&](const Numbers& q, Numbers& rates) { system.accelerations(q.data(), rates.data()); };
  odeint::symplectic_rkn_sb3a_mclachlan<Numbers> method;
  Stopwatch watch;
  watch.time([&] {
    for (std::size_t k = 0; k < steps; ++k)
      method.do_step(accelerations, std::make_pair(std::ref(displacements), std::ref(velocities)), 0.0, scaled_step);
  });
  std::copy(velocities.begin(), velocities.end(), std::copy(displacements.begin(), displacements.end(), state.begin()));
  return watch.seconds();
}

}  // namespace

std::vector<PeerMethod> odeint_methods() {
  std::vector<PeerMethod> methods;
  const auto add = [&](const char* name, bool adaptive, auto integrate) {
    methods.push_back({.library = "odeint", .name = name, .adaptive = adaptive, .integrate = integrate});
  };
  const auto add_pair = [&](const char* name, auto fixed, auto with_estimate) {
    add(name, false, [=](PeerSystem& system, Numbers& state, double duration, double effort) {
      return take_fixed_steps(fixed, system, state, duration, effort);
    });
    add(name, true, [=](PeerSystem& system, Numbers& state, double duration, double effort) {
      return control(with_estimate, system, state, duration, effort);
    });
  };
  add_pair("dopri5", odeint::runge_kutta_dopri5<Numbers>(), odeint::runge_kutta_dopri5<Numbers>());
  add_pair("fehlberg78", odeint::runge_kutta_fehlberg78<Numbers>(), odeint::runge_kutta_fehlberg78<Numbers>());
  add_pair("with pliant's vern8", vern8(), vern8_with_estimate());
  add("bulirsch_stoer", true, extrapolate);
  add("adams_bashforth_moulton 8", false, take_adams_steps);
  add("symplectic_rkn_sb3a", false, compose);
  methods.back().damps = false;
  return methods;
}

std::string boost_version() {
  return std::to_string(BOOST_VERSION / 100'000) + '.' + std::to_string(BOOST_VERSION / 100 % 1000) + '.' +
         std::to_string(BOOST_VERSION % 100);
}
#else
std::vector<PeerMethod> odeint_methods() { return {}; }
std::string boost_version() { return {}; }
#endif

}  // namespace pliant::bench
