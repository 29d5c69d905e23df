// Finds the bounds by scanning outward until a step first amplifies, then bisecting.
#include "dynamics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <string_view>

#include "core/expect.hpp"
#include "dynamics/forces/force.hpp"

namespace pliant {
namespace {

constexpr double amplification_limit = 1.0 + 1e-4;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int grid_count = 32;  // intervals of the damping rate
constexpr int largest_stage_count = 29;

// Returns the end of the interval that starts at 0 in which is_stable(y) holds, for methods of the sizes in use below y = 20. May
// return infinity if that is beyond `most`. Intervals of instability shorter than the stride may go unseen.
template <class Predicate>
double first_exit(double stride, const Predicate& is_stable, double most = infinity) {
  double inside = 0;
  while (is_stable(inside + stride)) {
    inside += stride;
    if (inside >= most) return infinity;
  }
  double outside = inside + stride;
  while (outside - inside > 1e-14 * outside) {
    const double middle = 0.5 * (inside + outside);
    (is_stable(middle) ? inside : outside) = middle;
  }
  return inside;
}

// Returns the coefficients of R(r e^(i angle)) as a polynomial of r.
std::vector<std::complex<double>> along_ray(const std::vector<double>& polynomial, double angle) {
  std::vector<std::complex<double>> coefficients;
  for (const double coefficient : polynomial)
    coefficients.push_back(std::polar(1.0, angle * static_cast<double>(coefficients.size())) * coefficient);
  return coefficients;
}

bool is_stable(const std::vector<std::complex<double>>& polynomial, double y) {
  std::complex<double> sum = 0;
  for (auto i = polynomial.rbegin(); i != polynomial.rend(); ++i) sum = sum * y + *i;
  return std::norm(sum) <= amplification_limit * amplification_limit;
}

// Returns the largest magnitude of the eigenvalues of the map that takes (x, v) = (1, 0) to `from_x` and (0, 1) to `from_v`.
double spectral_radius(const double (&from_x)[2], const double (&from_v)[2]) {
  const double trace = from_x[0] + from_v[1], determinant = from_x[0] * from_v[1] - from_x[1] * from_v[0];
  const double discriminant = trace * trace / 4 - determinant;
  if (discriminant < 0) return std::sqrt(determinant);
  return std::abs(trace) / 2 + std::sqrt(discriminant);
}

// Makes one step of length h = y on x'' = -x - g v. A kick damps exactly: v <- exp(-g t) v + (1 - exp(-g t))/g a.
double amplification(const Splitting& method, double y, double g) {
  double from_x[2] = {1, 0}, from_v[2] = {0, 1};
  for (std::size_t i = 0; i < method.kick.size(); ++i) {
    const double t = static_cast<double>(method.kick[i]) * y;
    const double decay = std::exp(-g * t), push = g > 0 ? -std::expm1(-g * t) / g : t;
    const double drift = i < method.drift.size() ? static_cast<double>(method.drift[i]) * y : 0;
    for (double* state : {from_x, from_v}) {
      state[1] = decay * state[1] - push * state[0];
      state[0] += drift * state[1];
    }
  }
  return spectral_radius(from_x, from_v);
}

// Makes one step of length h = y on x'' = -x, from state = {x, v}.
void oscillate(const NystromTableau& method, double y, double* state) {
  const double x = state[0], v = state[1];
  double accelerations[largest_stage_count + 1];
  for (int row = 0; row <= method.stages; ++row) {
    state[0] = x + method.c[row] * y * v;
    state[1] = method.keep[row] * v;
    for (int j = 0; j < row; ++j) {
      state[0] += y * y * method.position[row * method.stages + j] * accelerations[j];
      state[1] += y * method.velocity[row * method.stages + j] * accelerations[j];
    }
    accelerations[row] = -state[0];
  }
}

double amplification(const NystromTableau& method, double y) {
  PLIANT_EXPECT(method.stages <= largest_stage_count);
  double from_x[2] = {1, 0}, from_v[2] = {0, 1};
  for (double* state : {from_x, from_v}) oscillate(method, y, state);
  return spectral_radius(from_x, from_v);
}

// Below g = 2 omega, lambda runs along the circle |lambda| = omega. Above it, lambda runs along the real axis. On a ray the
// distance of the exit is the same for every lambda, so on the real axis only the far end matters.
double runge_kutta_bound(const RungeKutta& method, double omega, double damping_rate_max) {
  const std::vector<double> polynomial = stability_polynomial(method);
  const auto exit_along = [&](double angle, double most = infinity) {
    const auto on_ray = along_ray(polynomial, angle);
    return first_exit(
        1.0 / 256, [&](double radius) { return is_stable(on_ray, radius); }, most);
  };
  const double half_rate = damping_rate_max / 2;
  double bound = infinity;
  if (omega > 0) {
    const double last_angle = std::asin(std::min(1.0, half_rate / omega));
    for (int i = 0; i <= (damping_rate_max > 0 ? grid_count : 0); ++i)
      bound = std::min(bound, exit_along(std::numbers::pi / 2 + last_angle * i / grid_count, bound * omega) / omega);
  }
  if (half_rate > 0 && half_rate >= omega) {
    const double fastest = half_rate + std::sqrt((half_rate - omega) * (half_rate + omega));
    bound = std::min(bound, exit_along(std::numbers::pi) / fastest);
  }
  return bound;
}

// Returns how wrong a body is after a step with z = g h, if nothing but drag and gravity act on it. Errors from its velocity v
// are relative to v / g and v. Errors from gravity are relative to the final velocity, and to the way at that velocity in a time
// 1 / g.
double drift_error(const Integrator& integrator, double z) {
  const NystromTableau tableau = nystrom_tableau(integrator, Stages::of_result, z);
  double position = 0, velocity = 0;  // per unit of acceleration
  for (int j = tableau.stages * tableau.stages; j < tableau.stages * (tableau.stages + 1); ++j) {
    position += tableau.position[j];
    velocity += tableau.velocity[j];
  }
  const double lost = -std::expm1(-z);  // of the velocity
  return std::max({std::abs(z * tableau.c.back() - lost), std::abs(tableau.keep.back() - std::exp(-z)),
                   std::abs(z * z * position - (z - lost)), std::abs(z * velocity - lost)});
}

struct NystromBounds {
  double undamped;  // omega h
  double drifting;  // g h
};

// Finds the bounds once for each method. The first scan has to be fine, because dprkn8's first instability is a sliver,
// y = 3.1403 to 3.1416.
NystromBounds nystrom_bounds(const Integrator& integrator) {
  static std::map<std::string_view, NystromBounds> found;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto [place, is_new] = found.try_emplace(integrator.name);
  if (is_new) {
    const NystromTableau tableau = nystrom_tableau(integrator);
    place->second = {first_exit(1.0 / 4096, [&](double y) { return amplification(tableau, y) <= amplification_limit; }),
                     first_exit(1.0 / 16, [&](double z) { return 1 + drift_error(integrator, z) <= amplification_limit; })};
  }
  return place->second;
}

double splitting_bound(const Splitting& method, double omega, double damping_rate_max) {
  if (omega == 0) return infinity;  // free flight and its damping are exact
  const auto is_stable = [&](double y) {
    for (int i = 0; i <= (damping_rate_max > 0 ? grid_count : 0); ++i)
      if (!(amplification(method, y, damping_rate_max / omega * i / grid_count) <= amplification_limit)) return false;
    return true;
  };
  return first_exit(1.0 / 4096, is_stable) / omega;  // srkn11b's first instability is a sliver, y = 3.1414 to 3.1423
}

}  // namespace

std::vector<double> stability_polynomial(const RungeKutta& method) {
  std::vector<double> polynomial{1.0};
  std::vector<long double> power(method.stages, 1.0L);  // A^k (1, ..., 1)
  for (int k = 0; k < method.stages; ++k) {
    long double coefficient = 0;
    for (int i = 0; i < method.stages; ++i) coefficient += method.b[i] * power[i];
    polynomial.push_back(static_cast<double>(coefficient));
    // A has numbers only below the diagonal, so from the last row up the product can replace its factor.
    for (int i = method.stages - 1; i >= 0; --i) {
      long double sum = 0;
      for (int j = 0; j < i; ++j) sum += method.a[i * method.stages + j] * power[j];
      power[i] = sum;
    }
  }
  return polynomial;
}

double undamped_amplification(const Integrator& integrator, double omega_step) {
  return amplification(nystrom_tableau(integrator), omega_step);
}

double stiffest_frequency_squared(const ModelBody& body) {
  double sum = 0;
  for (const Force& force : forces())
    if (feels(body, force)) sum += force.frequency_squared(body);
  return sum;
}

double stiffest_frequency(const ModelBody& body) { return std::sqrt(stiffest_frequency_squared(body)); }

double largest_damping_rate(const ModelBody& body, DampingLaw law) {
  if (law == DampingLaw::none) return 0;
  return (law == DampingLaw::adaptive ? 10.0 : 1.0) * body.damping / body.vertex_mass;
}

double step_bound(const Integrator& integrator, double omega_squared, double damping_rate_max) {
  PLIANT_EXPECT(std::isfinite(omega_squared) && omega_squared >= 0);
  PLIANT_EXPECT(std::isfinite(damping_rate_max) && damping_rate_max >= 0);
  PLIANT_EXPECT(damping_rate_max == 0 || allows_damping(integrator, DampingLaw::constant));
  const double omega = std::sqrt(omega_squared);
  if (const auto* method = std::get_if<RungeKutta>(&integrator.method))
    return runge_kutta_bound(*method, omega, damping_rate_max);
  if (std::holds_alternative<Nystrom>(integrator.method))
    return omega > 0 ? nystrom_bounds(integrator).undamped / omega : infinity;
  return splitting_bound(std::get<Splitting>(integrator.method), omega, damping_rate_max);
}

double step_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law) {
  const double rate = largest_damping_rate(body, law);
  return std::min(step_bound(integrator, stiffest_frequency_squared(body), rate), step_bound(integrator, 0, rate));
}

double drag_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law) {
  const double rate = largest_damping_rate(body, law);
  if (rate == 0 || !std::holds_alternative<Nystrom>(integrator.method)) return infinity;
  return nystrom_bounds(integrator).drifting / rate;
}

}  // namespace pliant
