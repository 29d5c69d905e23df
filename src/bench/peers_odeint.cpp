// Boost.odeint's methods: Runge-Kutta, extrapolation, Adams and a symplectic one.
#include "bench/peers.hpp"

#ifdef PLIANT_ODEINT
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <functional>
#include <utility>

#include "core/stopwatch.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_ODEINT
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

auto rates_of(PeerSystem& system) {
  return [&system](const Numbers& y, Numbers& rates, double) { system.rates(y.data(), rates.data()); };
}

template <class Method>
double take_fixed_steps(PeerSystem& system, Numbers& state, double duration, double effort) {
  const auto steps = static_cast<std::size_t>(std::llround(effort));
  const double step = duration / static_cast<double>(steps);
  Method method;
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
double control(PeerSystem& system, Numbers& state, double duration, double effort) {
  return take_adaptive_steps(odeint::make_controlled<Method>(effort * size_of_numbers(state), effort), system, state, duration);
}

double extrapolate(PeerSystem& system, Numbers& state, double duration, double effort) {
  return take_adaptive_steps(odeint::bulirsch_stoer<Numbers>(effort * size_of_numbers(state), effort), system, state, duration);
}

// Started by a method of its own order.
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
  using Fehlberg = odeint::runge_kutta_fehlberg78<Numbers>;
  using Dopri = odeint::runge_kutta_dopri5<Numbers>;
  const auto method = [](const char* name, bool adaptive, double largest_step, auto integrate) {
    return PeerMethod{
        .library = "odeint", .name = name, .adaptive = adaptive, .largest_step = largest_step, .integrate = integrate};
  };
  std::vector<PeerMethod> methods = {method("dopri5", false, 2, take_fixed_steps<Dopri>),
                                     method("dopri5", true, 0, control<Dopri>),
                                     method("fehlberg78", false, 3, take_fixed_steps<Fehlberg>),
                                     method("fehlberg78", true, 0, control<Fehlberg>),
                                     method("bulirsch_stoer", true, 0, extrapolate),
                                     method("adams_bashforth_moulton 8", false, 0.5, take_adams_steps),
                                     method("symplectic_rkn_sb3a", false, 2, compose)};
  methods.back().damps = false;
  return methods;
}
#else
std::vector<PeerMethod> odeint_methods() { return {}; }
#endif

}  // namespace pliant::bench
