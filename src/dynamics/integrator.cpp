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

void append(NystromTableau& tableau, long double position, long double velocity) {
  tableau.position.push_back(static_cast<double>(position));
  tableau.velocity.push_back(static_cast<double>(velocity));
}

// Appends the row of the used stages, for weights of the step's end: (weights A)_k and weights_k, ...
void append_end(NystromTableau& tableau, const RungeKutta& method, const long double* weights, std::span<const int> used) {
  for (const int k : used) {
    long double sum = 0;
    for (const int j : used) sum += weights[j] * method.a[j * method.stages + k];
    append(tableau, sum, weights[k]);
  }
}

// ... or weights_k (1 - c_k) and weights_k.
void append_end(NystromTableau& tableau, const Nystrom& method, const long double* weights, std::span<const int> used) {
  for (const int k : used) append(tableau, weights[k] * (1 - method.c[k]), weights[k]);
}

void append_stage(NystromTableau& tableau, const RungeKutta& method, int stage, std::span<const int> used) {
  append_end(tableau, method, &method.a[stage * method.stages], used);
}

void append_stage(NystromTableau& tableau, const Nystrom& method, int stage, std::span<const int> used) {
  for (const int k : used) append(tableau, method.a[stage * method.stages + k], 0);
}

template <class Method>
NystromTableau tableau_of(const Method& method, std::span<const int> used) {
  NystromTableau tableau{static_cast<int>(used.size()), {}, {}, {}};
  for (const int i : used) {
    append_stage(tableau, method, i, used);
    tableau.c.push_back(static_cast<double>(method.c[i]));
  }
  append_end(tableau, method, method.b.data(), used);
  tableau.c.push_back(1.0);
  return tableau;
}

// How much farther than by the embedded weights a step goes, as a row.
template <class Method>
NystromTableau difference_to(const std::vector<long double>& embedded, const Method& method, std::span<const int> used) {
  std::vector<long double> difference = method.b;
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= embedded[i];
  NystromTableau row;
  append_end(row, method, difference.data(), used);
  return row;
}

template <class Function>
auto visit_staged(const Integrator& integrator, const Function& function) {
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return function(*method);
  return function(std::get<RungeKutta>(integrator.method));
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

const StagedMethod* staged_method(const Integrator& integrator) {
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return method;
  return std::get_if<RungeKutta>(&integrator.method);
}

int evaluations_per_step(const Integrator& integrator) {
  if (const StagedMethod* method = staged_method(integrator))
    return static_cast<int>(used_stages(*method, Stages::of_result).size());
  return static_cast<int>(std::get<Splitting>(integrator.method).drift.size());
}

bool allows_damping(const Integrator& integrator) {
  if (std::holds_alternative<Nystrom>(integrator.method)) return false;
  const auto* splitting = std::get_if<Splitting>(&integrator.method);
  return splitting == nullptr || std::ranges::all_of(splitting->kick, [](long double kick) { return kick >= 0; });
}

NystromTableau nystrom_tableau(const Integrator& integrator, Stages stages) {
  return visit_staged(integrator, [&](const auto& method) { return tableau_of(method, used_stages(method, stages)); });
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
    const NystromTableau row = visit_staged(integrator, [&](const auto& m) { return difference_to(*embedded, m, used); });
    for (std::size_t j = 0; j < used.size(); ++j) {
      weights[4 * j + column] = row.position[j];
      weights[4 * j + column + 1] = row.velocity[j];
    }
  }
  return weights;
}

}  // namespace pliant
