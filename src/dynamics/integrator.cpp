// Looks integrators up, and computes what follows from their coefficients.
#include "dynamics/integrator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

bool has_weight(const std::vector<long double>& weights, int stage) { return !weights.empty() && weights[stage] != 0; }

// Returns the stages that reach the end of the step, or an estimate of its error, through weights or through other such stages.
std::vector<int> used_stages(const StagedMethod& method, Stages wanted) {
  std::vector<bool> used(method.stages);
  std::vector<int> stages;
  for (int i = method.stages - 1; i >= 0; --i) {
    used[i] = has_weight(method.b, i);
    if (wanted == Stages::of_estimates) used[i] = used[i] || has_weight(method.b_hat, i) || has_weight(method.b_hat2, i);
    for (int later : stages) used[i] = used[i] || method.a[later * method.stages + i] != 0;
    if (used[i]) stages.insert(stages.begin(), i);
  }
  return stages;
}

// A displacement is of_start h v + h^2 sum_k of_stages[k] a_k. v is the velocity at the step's start, and a_k are the used
// stages' accelerations.
struct Sum {
  long double of_start = 0;
  std::vector<long double> of_stages = {};
};

// For a velocity, the sum is of_start v + h sum_k of_stages[k] a_k.
struct Row {
  Sum position, velocity;
};

void append(NystromTableau& tableau, const Row& row) {
  tableau.c.push_back(static_cast<double>(row.position.of_start));
  tableau.keep.push_back(static_cast<double>(row.velocity.of_start));
  for (const long double weight : row.position.of_stages) tableau.position.push_back(static_cast<double>(weight));
  for (const long double weight : row.velocity.of_stages) tableau.velocity.push_back(static_cast<double>(weight));
}

// The slopes of positions are the stages' velocities, so positions weigh accelerations by `weights` times A.
class RungeKuttaRows {
 public:
  RungeKuttaRows(const RungeKutta& method, std::span<const int> used) : method_(method), used_(used) {}

  [[nodiscard]] Row stage(int i) const { return row(&method_.a[i * method_.stages], method_.c[i]); }
  [[nodiscard]] Row end(const std::vector<long double>& weights) const { return row(weights.data(), 1); }

 private:
  [[nodiscard]] Row row(const long double* weights, long double c) const {
    Row row{{c}, {1}};
    for (const int k : used_) {
      long double sum = 0;
      for (const int j : used_) sum += weights[j] * method_.a[j * method_.stages + k];
      row.position.of_stages.push_back(sum);
      row.velocity.of_stages.push_back(weights[k]);
    }
    return row;
  }

  const RungeKutta& method_;
  std::span<const int> used_;
};

// With drag, x'' = a(x) - g v, the method steps on y = e^(g t / 2) (x - x(0)). The equation of y knows no velocity:
//   y'' = e^(g t / 2) a(x) + (g / 2)^2 y, with y(0) = 0, y'(0) = v(0), and v = e^(-g t / 2) y' - (g / 2) (x - x(0)).
// Its stages are linear in v(0) and the a(x), which makes them rows once more. Taken back to x, a weight decays by e^(-g t / 2)
// over the time from its stage to the row's.
class NystromRows {
 public:
  NystromRows(const Nystrom& method, std::span<const int> used, double drag) : method_(method), used_(used), half_(drag / 2) {
    for (const int i : used) stages_.push_back(sum(method.c[i], &method.a[i * method.stages], method.c[i]));
  }

  [[nodiscard]] Row stage(int i) const {
    const auto index = std::ranges::find(used_, i) - used_.begin();
    return {stages_[index], {1, std::vector<long double>(used_.size())}};
  }
  [[nodiscard]] Row end(const std::vector<long double>& weights) const {
    std::vector<long double> of_position = weights;
    for (int i = 0; i < method_.stages; ++i) of_position[i] *= 1 - method_.c[i];
    Row row{sum(1, of_position.data(), 1), sum(1, weights.data(), 1)};
    row.velocity.of_start -= half_ * row.position.of_start;
    for (std::size_t k = 0; k < used_.size(); ++k) row.velocity.of_stages[k] -= half_ * row.position.of_stages[k];
    return row;
  }

 private:
  // Returns the sum of of_start v(0) and the weighted y'' of the stages before, at the time c.
  [[nodiscard]] Sum sum(long double of_start, const long double* weights, long double c) const {
    Sum result{of_start * std::exp(-half_ * c), std::vector<long double>(used_.size())};
    for (std::size_t j = 0; j < stages_.size(); ++j) {
      const long double weight = weights[used_[j]] * std::exp(-half_ * (c - method_.c[used_[j]]));
      result.of_stages[j] += weight;
      result.of_start += half_ * half_ * weight * stages_[j].of_start;
      for (std::size_t k = 0; k < j; ++k) result.of_stages[k] += half_ * half_ * weight * stages_[j].of_stages[k];
    }
    return result;
  }

  const Nystrom& method_;
  std::span<const int> used_;
  long double half_;  // g h / 2
  std::vector<Sum> stages_;
};

template <class Function>
auto visit_rows(const Integrator& integrator, std::span<const int> used, double drag, const Function& function) {
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return function(NystromRows(*method, used, drag));
  PLIANT_EXPECT(drag == 0);
  return function(RungeKuttaRows(std::get<RungeKutta>(integrator.method), used));
}

}  // namespace

const Integrator& find_integrator(std::string_view name, const Origin& where) {
  const auto all = integrators();
  const auto found = std::ranges::find(all, name, &Integrator::name);
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  std::ranges::transform(all, std::back_inserter(names), &Integrator::name);
  throw Error(where, fmt::format("there is no integrator \"{}\"", name),
              fmt::format("choose one of {}; with a tolerance also auto", fmt::join(names, ", ")));
}

const StagedMethod* staged_method(const Integrator& integrator) {
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return method;
  return std::get_if<RungeKutta>(&integrator.method);
}

int evaluations_per_step(const Integrator& integrator) {
  if (const StagedMethod* method = staged_method(integrator))
    return static_cast<int>(used_stages(*method, Stages::of_result).size());
  return static_cast<int>(std::get<Splitting>(integrator.method).drift.size());
}

bool has_forces_at_ends(const Integrator& integrator) {
  const auto* splitting = std::get_if<Splitting>(&integrator.method);
  return splitting != nullptr && splitting->drift.size() == 1;
}

bool allows_damping(const Integrator& integrator, DampingLaw law) {
  if (law == DampingLaw::none || std::holds_alternative<RungeKutta>(integrator.method)) return true;
  if (std::holds_alternative<Nystrom>(integrator.method)) return law == DampingLaw::constant;
  return std::ranges::all_of(std::get<Splitting>(integrator.method).kick, [](long double kick) { return kick >= 0; });
}

NystromTableau nystrom_tableau(const Integrator& integrator, Stages stages, double drag) {
  PLIANT_EXPECT(staged_method(integrator) != nullptr);
  const StagedMethod& method = *staged_method(integrator);
  const std::vector<int> used = used_stages(method, stages);
  NystromTableau tableau{.stages = static_cast<int>(used.size())};
  visit_rows(integrator, used, drag, [&](const auto& rows) {
    for (const int i : used) append(tableau, rows.stage(i));
    append(tableau, rows.end(method.b));
  });
  return tableau;
}

bool estimates_error(const Integrator& integrator) {
  const StagedMethod* method = staged_method(integrator);
  return method != nullptr && method->order_hat > 0;
}

int estimate_order(const StagedMethod& method) {
  if (method.order_hat2 == 0) return method.order_hat + 1;
  return 2 * (method.order_hat + 1) - (method.order_hat2 + 1);
}

std::vector<double> error_weights(const Integrator& integrator) {
  PLIANT_EXPECT(estimates_error(integrator));
  const StagedMethod& method = *staged_method(integrator);
  const std::vector<int> used = used_stages(method, Stages::of_estimates);
  std::vector<double> weights(4 * used.size());
  for (const auto& [embedded, column] : {std::pair{&method.b_hat, 0u}, {&method.b_hat2, 2u}}) {
    if (embedded->empty()) continue;
    std::vector<long double> difference = method.b;
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= (*embedded)[i];
    const Row row = visit_rows(integrator, used, 0, [&](const auto& rows) { return rows.end(difference); });
    for (std::size_t j = 0; j < used.size(); ++j) {
      weights[4 * j + column] = static_cast<double>(row.position.of_stages[j]);
      weights[4 * j + column + 1] = static_cast<double>(row.velocity.of_stages[j]);
    }
  }
  return weights;
}

}  // namespace pliant
