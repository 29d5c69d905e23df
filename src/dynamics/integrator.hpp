// Integrators are data: the tableau of a Runge-Kutta or Nystrom method, or the coefficients of a splitting. One stepper runs all.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/scene_description.hpp"

namespace pliant {

/// What explicit methods with stages consist of. Embedded weights estimate the error. Their order is 0 if there are none.
struct StagedMethod {
  int stages = 0;
  std::vector<long double> a;  // stages x stages, row by row, with zeros on and above the diagonal
  std::vector<long double> b, c;
  std::vector<long double> b_hat = {}, b_hat2 = {};
  int order_hat = 0, order_hat2 = 0;
};

/// A Runge-Kutta method, on x' = v, v' = a(x, v).
struct RungeKutta : StagedMethod {};

/// A Runge-Kutta-Nystrom method, on x'' = a(x). Its stages have no velocities, so it allows only the constant damping law.
/// Its stages and the step's end, or with b_hat for b the embedded result, are
///   x_i   = x + c_i h v + h^2 sum_j a_ij a(x_j)
///   x_end = x + h v + h^2 sum_j b_j (1 - c_j) a(x_j)
///   v_end = v + h sum_j b_j a(x_j).
struct Nystrom : StagedMethod {};

/// A symmetric composition kick, drift, kick, ..., kick: v += kick[i] h a(x), then x += drift[i] h v.
/// kick.size() == drift.size() + 1. The last kick's acceleration serves the next step's first kick, unless x has changed in
/// between.
struct Splitting {
  std::vector<long double> kick, drift;  // each sums to 1
};

struct Integrator {
  std::string_view name;         // as scenes write it
  std::string_view description;  // half a line
  std::string_view source;       // where the coefficients come from
  int order = 0;
  double strained_bound = 1;  // the measured part of the step bound that spheres squashed to a half bear, at most 1
  std::variant<RungeKutta, Nystrom, Splitting> method;
  double fp32_tolerance = 1e-7;  // the smallest one that steps meet where forces are in fp32
};

/// Every integrator, in the order `pliant info --integrators` lists them.
[[nodiscard]] std::span<const Integrator> integrators();

/// Returns the integrator of that name. If there is none, throws Error that lists the names and blames `where`.
[[nodiscard]] const Integrator& find_integrator(std::string_view name, const Origin& where = {});

/// Returns null if the method is a splitting.
[[nodiscard]] const StagedMethod* staged_method(const Integrator& integrator);

/// Returns the force evaluations of one step: the stages that reach the result, or a splitting's drifts. A splitting keeps its
/// last acceleration.
[[nodiscard]] int evaluations_per_step(const Integrator& integrator);

/// Returns whether forces act at the ends of steps alone. Then the positions at a step's end follow from its start.
[[nodiscard]] bool has_forces_at_ends(const Integrator& integrator);

/// Returns whether the method allows the damping law. A splitting damps with every kick, so a negative kick would feed energy in.
/// A Nystrom method's stages have no velocities to damp, but its weights can hold a constant rate of damping.
[[nodiscard]] bool allows_damping(const Integrator& integrator, DampingLaw law);

/// Returns whether the method has embedded weights, so that a tolerance can govern its steps.
[[nodiscard]] bool estimates_error(const Integrator& integrator);

/// Returns the power of the step with which the estimated error grows. Two estimates e and f are joined as
/// e^2 / sqrt(e^2 + f^2 / 100).
[[nodiscard]] int estimate_order(const StagedMethod& method);

/// Which stages count: those that reach the step's end, or those that reach the error estimates as well.
enum class Stages { of_result, of_estimates };

/// A method with stages on x'' = a(x, v), in a form for which only accelerations have to be stored. Rows are stages, and
/// row = stages is the end of the step:
///   x_row = x + c[row] h v    + h^2 sum_j position[row * stages + j] a_j
///   v_row =     keep[row] v   + h   sum_j velocity[row * stages + j] a_j
struct NystromTableau {
  int stages = 0;
  std::vector<double> c = {};         // stages + 1: without drag the stages' times, then 1
  std::vector<double> keep = {};      // stages + 1: without drag 1
  std::vector<double> position = {};  // (stages + 1) x stages: A A, then b A, or for a Nystrom method A, then b (1 - c)
  std::vector<double> velocity = {};  // (stages + 1) x stages: A, or zeros for a Nystrom method, then b
};

/// Returns the tableau, computed in long double and rounded once. That of a Nystrom method can be made for x'' = a(x) - g v. Then
/// `drag` is g h, and the a_j are only a(x_j). Expects no splitting.
[[nodiscard]] NystromTableau nystrom_tableau(const Integrator& integrator, Stages stages = Stages::of_result, double drag = 0);

/// Returns 4 weights for each stage of nystrom_tableau(integrator, Stages::of_estimates). The step's end is farther than the
/// embedded method's by
///   h^2 sum_j weights[4 j]     a_j in position,
///   h   sum_j weights[4 j + 1] a_j in velocity.
/// The other two weights are the second estimate's, or zero. Expects a method with an estimate.
[[nodiscard]] std::vector<double> error_weights(const Integrator& integrator);

}  // namespace pliant
