// Looking integrators up, and what follows from their coefficients.
#include "dynamics/integrator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"

namespace pliant {
namespace {

// The stages that reach the end of the step, through its weights or through other such stages.
std::vector<int> used_stages(const RungeKutta& method) {
  std::vector<bool> used(method.stages);
  std::vector<int> stages;
  for (int i = method.stages - 1; i >= 0; --i) {
    used[i] = method.b[i] != 0;
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
  if (const auto* method = std::get_if<RungeKutta>(&integrator.method)) return static_cast<int>(used_stages(*method).size());
  return static_cast<int>(std::get<Splitting>(integrator.method).drift.size());
}

bool allows_damping(const Integrator& integrator) {
  const auto* splitting = std::get_if<Splitting>(&integrator.method);
  return splitting == nullptr || std::ranges::all_of(splitting->kick, [](long double kick) { return kick >= 0; });
}

NystromTableau nystrom_tableau(const RungeKutta& method) {
  const std::vector<int> used = used_stages(method);
  NystromTableau tableau{static_cast<int>(used.size()), {}, {}, {}};
  for (const int i : used) {
    append_row(tableau, method, &method.a[i * method.stages], used);
    tableau.c.push_back(static_cast<double>(method.c[i]));
  }
  append_row(tableau, method, method.b.data(), used);
  tableau.c.push_back(1.0);
  return tableau;
}

}  // namespace pliant
