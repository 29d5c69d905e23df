// Looking integrators up, and what follows from their coefficients.
#include "dynamics/integrator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/expect.hpp"

namespace pliant {
namespace {

bool has_weight(const std::vector<long double>& weights, int stage) { return !weights.empty() && weights[stage] != 0; }

// The stages that reach the end of the step, or an estimate of its error, through weights or through other such stages.
std::vector<int> used_stages(const RungeKutta& method, Stages wanted) {
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

// Appends weights_k and (weights A)_k of the used stages k as a row each of `velocity` and `position`.
void append_row(NystromTableau& tableau, const RungeKutta& method, const long double* weights, std::span<const int> used) {
  for (const int k : used) {
    long double sum = 0;
    for (const int j : used) sum += weights[j] * method.a[j * method.stages + k];
    tableau.position.push_back(static_cast<double>(sum));
    tableau.velocity.push_back(static_cast<double>(weights[k]));
  }
}

}  // namespace

const Integrator& find_integrator(std::string_view name, const std::string& where) {
  const auto all = integrators();
  const auto found = std::ranges::find(all, name, &Integrator::name);
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  std::ranges::transform(all, std::back_inserter(names), &Integrator::name);
  throw Error(fault_of(where), where, fmt::format("there is no integrator \"{}\"", name),
              fmt::format("choose one of {}", fmt::join(names, ", ")));
}

int evaluations_per_step(const Integrator& integrator) {
  if (const auto* method = std::get_if<RungeKutta>(&integrator.method))
    return static_cast<int>(used_stages(*method, Stages::of_result).size());
  return static_cast<int>(std::get<Splitting>(integrator.method).drift.size());
}

bool allows_damping(const Integrator& integrator) {
  const auto* splitting = std::get_if<Splitting>(&integrator.method);
  return splitting == nullptr || std::ranges::all_of(splitting->kick, [](long double kick) { return kick >= 0; });
}

NystromTableau nystrom_tableau(const RungeKutta& method, Stages stages) {
  const std::vector<int> used = used_stages(method, stages);
  NystromTableau tableau{static_cast<int>(used.size()), {}, {}, {}};
  for (const int i : used) {
    append_row(tableau, method, &method.a[i * method.stages], used);
    tableau.c.push_back(static_cast<double>(method.c[i]));
  }
  append_row(tableau, method, method.b.data(), used);
  tableau.c.push_back(1.0);
  return tableau;
}

bool estimates_error(const Integrator& integrator) {
  const auto* method = std::get_if<RungeKutta>(&integrator.method);
  return method != nullptr && method->order_hat > 0;
}

int estimate_order(const RungeKutta& method) {
  if (method.order_hat2 == 0) return method.order_hat + 1;
  return 2 * (method.order_hat + 1) - (method.order_hat2 + 1);
}

std::vector<double> error_weights(const RungeKutta& method) {
  PLIANT_EXPECT(method.order_hat > 0);
  const std::vector<int> used = used_stages(method, Stages::of_estimates);
  std::vector<double> weights(4 * used.size());
  for (const auto& [embedded, column] : {std::pair{&method.b_hat, 0u}, {&method.b_hat2, 2u}}) {
    if (embedded->empty()) continue;
    std::vector<long double> difference = method.b;
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= (*embedded)[i];
    NystromTableau row;
    append_row(row, method, difference.data(), used);
    for (std::size_t j = 0; j < used.size(); ++j) {
      weights[4 * j + column] = row.position[j];
      weights[4 * j + column + 1] = row.velocity[j];
    }
  }
  return weights;
}

}  // namespace pliant
