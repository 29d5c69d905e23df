// Integrators are data: a Runge-Kutta tableau or the coefficients of a splitting. One stepper runs them all.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pliant {

/// An explicit Runge-Kutta method. Embedded weights estimate the error; their order is 0 where there are none.
struct RungeKutta {
  int stages = 0;
  std::vector<long double> a;  // stages x stages, row by row; zero on and above the diagonal
  std::vector<long double> b, c;
  std::vector<long double> b_hat = {}, b_hat2 = {};
  int order_hat = 0, order_hat2 = 0;
};

/// A symmetric composition kick, drift, kick, ..., kick: v += kick[i] h a(x), then x += drift[i] h v.
/// kick.size() == drift.size() + 1. The last kick's acceleration serves the next step's first, unless x changed between.
struct Splitting {
  std::vector<long double> kick, drift;  // each sums to 1
};

struct Integrator {
  std::string_view name;         // as scenes write it
  std::string_view description;  // half a line
  std::string_view source;       // where the coefficients come from
  int order = 0;
  double strained_bound = 1;  // the part of the step bound that a body squashed to a half bears; measured, at most 1
  std::variant<RungeKutta, Splitting> method;
};

/// Every integrator, in the order `pliant info --integrators` lists them.
[[nodiscard]] std::span<const Integrator> integrators();

/// Throws Error (fault_of(where)) that lists the names; `where` is the place to blame, such as "file:line: field".
[[nodiscard]] const Integrator& find_integrator(std::string_view name, const std::string& where = "");

/// Force evaluations of one step: stages that reach the result, or a splitting's drifts (its last acceleration is kept).
[[nodiscard]] int evaluations_per_step(const Integrator& integrator);

/// Whether the method may meet damping. A splitting damps with every kick, so a negative kick would feed energy in.
[[nodiscard]] bool allows_damping(const Integrator& integrator);

/// Whether the method is a Runge-Kutta one with embedded weights, so that a tolerance can govern its steps.
[[nodiscard]] bool estimates_error(const Integrator& integrator);

/// The power of the step with which the estimated error grows. Two estimates are joined as e^2 / sqrt(e^2 + f^2 / 100).
[[nodiscard]] int estimate_order(const RungeKutta& method);

/// Which stages count: those that reach the step's end, or those that reach the error estimates as well.
enum class Stages { of_result, of_estimates };

/// A Runge-Kutta method on x'' = a(x, v), for which accelerations alone have to be stored. With row = stage, or row = stages for
/// the end of the step:
///   x_row = x + c[row] h v + h^2 sum_j position[row * stages + j] a_j
///   v_row = v +              h   sum_j velocity[row * stages + j] a_j
struct NystromTableau {
  int stages = 0;
  std::vector<double> c;         // stages + 1, the last is 1
  std::vector<double> position;  // (stages + 1) x stages: A A, then b A
  std::vector<double> velocity;  // (stages + 1) x stages: A, then b
};

/// Computed in long double and rounded once.
[[nodiscard]] NystromTableau nystrom_tableau(const RungeKutta& method, Stages stages = Stages::of_result);

/// (stages of nystrom_tableau(method, Stages::of_estimates)) x 4. The step's end is farther than that of the embedded method by
///   h^2 sum_j weights[4 j] a_j in position, h sum_j weights[4 j + 1] a_j in velocity;
/// the other two are the second estimate's, or zero. Expects a method with an estimate.
[[nodiscard]] std::vector<double> error_weights(const RungeKutta& method);

}  // namespace pliant
