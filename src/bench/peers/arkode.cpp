// Runs SUNDIALS ARKODE's explicit Runge-Kutta methods (ERKStep) with its own tables, and with pliant's coefficients of Vern8.
#include "bench/peers/peers.hpp"

#ifdef PLIANT_SUNDIALS
#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <limits>

#include "bench/peers/sundials.hpp"
#include "core/expect.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_SUNDIALS
namespace {

using Table = ARKODE_ERKTableID;
constexpr Table pliants_vern8 = ARKODE_ERK_NONE;

// Makes a table of the stages that reach the result, or of all stages with an estimate. The caller frees it.
ARKodeButcherTable table_of(const Integrator& integrator, bool with_estimate) {
  const auto& method = std::get<RungeKutta>(integrator.method);
  const int stages = with_estimate ? method.stages : evaluations_per_step(integrator);
  std::vector<double> a;
  for (int i = 0; i < stages; ++i)
    for (int j = 0; j < stages; ++j) a.push_back(static_cast<double>(method.a[i * method.stages + j]));
  const auto rounded = [](const std::vector<long double>& values) { return std::vector<double>(values.begin(), values.end()); };
  std::vector<double> b = rounded(method.b), c = rounded(method.c), estimate = rounded(method.b_hat);
  return ARKodeButcherTable_Create(stages, integrator.order, with_estimate ? method.order_hat : 0, c.data(), a.data(), b.data(),
                                   with_estimate ? estimate.data() : nullptr);
}

// If the last stage's c is 1, ARKODE 5.4 takes that stage for the next step's first. That is right only if its row of A is b.
// Other methods lose their order, so this function changes their c. Forces here do not depend on time, so c has no other effect.
void mend(ARKodeButcherTable table) {
  const int last = table->stages - 1;
  bool is_end = true;
  for (int j = 0; j <= last; ++j) is_end = is_end && table->A[last][j] == table->b[j];
  if (!is_end) table->c[last] = 0.5;
}

// Everything that one run holds.
class Session {
 public:
  Session(PeerSystem& system, std::vector<double>& numbers)
      : state_(numbers), memory_(ERKStepCreate(sundials_rates, 0, state_.vector(), state_.context())) {
    PLIANT_EXPECT(memory_ != nullptr);
    expect_success(ERKStepSetUserData(memory_, &system));
    expect_success(ERKStepSetErrHandlerFn(memory_, say_nothing, nullptr));
    expect_success(ERKStepSetMaxNumSteps(memory_, -1));       // no limit
    expect_success(ERKStepSetInterpolantDegree(memory_, 1));  // a higher degree evaluates more forces, and nothing interpolates
  }
  ~Session() { ERKStepFree(&memory_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void choose(Table which, bool adaptive) {
    ARKodeButcherTable table =
        which == pliants_vern8 ? table_of(find_integrator("vern8"), adaptive) : ARKodeButcherTable_LoadERK(which);
    PLIANT_EXPECT(table != nullptr);
    mend(table);
    expect_success(ERKStepSetTable(memory_, table));  // copies it
    ARKodeButcherTable_Free(table);
  }
  void fix_step(double step) { expect_success(ERKStepSetFixedStep(memory_, step)); }
  void set_tolerance(double relative, double absolute) { expect_success(ERKStepSStolerances(memory_, relative, absolute)); }
  void end_at(double time) { expect_success(ERKStepSetStopTime(memory_, time)); }

  /// Returns false if it fails.
  bool evolve(double end) {
    double reached = 0;
    return ERKStepEvolve(memory_, end, state_.vector(), &reached, ARK_NORMAL) >= 0;
  }

 private:
  SundialsState state_;
  void* memory_;
};

double integrate(PeerSystem& system, std::vector<double>& state, double duration, double effort, Table table, bool adaptive) {
  Session session(system, state);
  session.choose(table, adaptive);
  session.end_at(duration);
  if (adaptive)
    session.set_tolerance(effort, effort * size_of_numbers(state));
  else
    session.fix_step(duration / effort);
  Stopwatch watch;
  if (!watch.time([&] { return session.evolve(duration); })) std::ranges::fill(state, std::numeric_limits<double>::quiet_NaN());
  return watch.seconds();
}

void add(std::vector<PeerMethod>& methods, const char* name, Table table) {
  for (const bool adaptive : {false, true})
    methods.push_back({.library = "ARKODE",
                       .name = name,
                       .adaptive = adaptive,
                       .integrate = [=](PeerSystem& system, std::vector<double>& state, double duration, double effort) {
                         return integrate(system, state, duration, effort, table, adaptive);
                       }});
}

}  // namespace

std::vector<PeerMethod> arkode_methods() {
  std::vector<PeerMethod> methods;
  add(methods, "dormand_prince_7_4_5", ARKODE_DORMAND_PRINCE_7_4_5);
  add(methods, "verner_8_5_6", ARKODE_VERNER_8_5_6);
  add(methods, "fehlberg_13_7_8", ARKODE_FEHLBERG_13_7_8);
  add(methods, "with pliant's vern8", pliants_vern8);
  return methods;
}
#else
std::vector<PeerMethod> arkode_methods() { return {}; }
#endif

}  // namespace pliant::bench
