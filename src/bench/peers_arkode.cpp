// SUNDIALS ARKODE's explicit Runge-Kutta methods (ERKStep), with its own tables, and with pliant's coefficients of Vern8.
#include "bench/peers.hpp"

#ifdef PLIANT_ARKODE
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/expect.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_ARKODE
namespace {

using Table = ARKODE_ERKTableID;
constexpr Table pliants_vern8 = ARKODE_ERK_NONE;

int rates_of(realtype, N_Vector y, N_Vector rates, void* system) {
  static_cast<PeerSystem*>(system)->rates(N_VGetArrayPointer(y), N_VGetArrayPointer(rates));
  return 0;
}

void say_nothing(int, const char*, const char*, char*, void*) {}

// The caller frees it.
ARKodeButcherTable table_of(const Integrator& integrator) {
  const auto& method = std::get<RungeKutta>(integrator.method);
  const auto rounded = [](const std::vector<long double>& values) { return std::vector<double>(values.begin(), values.end()); };
  std::vector<double> a = rounded(method.a), b = rounded(method.b), c = rounded(method.c), estimate = rounded(method.b_hat);
  return ARKodeButcherTable_Create(method.stages, integrator.order, method.order_hat, c.data(), a.data(), b.data(),
                                   estimate.data());
}

// ARKODE 5.4 takes the last stage for the next step's first wherever its c is 1, though that holds only where its row of A is b:
// other methods lose their order. Forces here do not depend on time, so that another c changes nothing else.
void mend(ARKodeButcherTable table) {
  const int last = table->stages - 1;
  bool is_end = true;
  for (int j = 0; j <= last; ++j) is_end = is_end && table->A[last][j] == table->b[j];
  if (!is_end) table->c[last] = 0.5;
}

// Vector operations compiled here: Debian builds those of SUNDIALS without optimisation, and they would cost ARKODE as much time
// as the forces of a small body. Vectors that it clones take them over.
int combine(int count, realtype* factors, N_Vector* vectors, N_Vector result) {
  constexpr int most = 32;
  PLIANT_EXPECT(count <= most);
  const realtype* terms[most];
  for (int k = 0; k < count; ++k) terms[k] = N_VGetArrayPointer(vectors[k]);
  realtype* const to = N_VGetArrayPointer(result);
  constexpr sunindextype block = 64;
  for (sunindextype first = 0, size = N_VGetLength(result); first < size; first += block) {
    const sunindextype length = std::min(block, size - first);
    realtype sum[block] = {};
    for (int k = 0; k < count; ++k)
      for (sunindextype i = 0; i < length; ++i) sum[i] += factors[k] * terms[k][first + i];
    std::copy_n(sum, length, to + first);  // after all terms, for the result may be one of them
  }
  return 0;
}

void add_two(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector result) {
  realtype factors[] = {a, b};
  N_Vector vectors[] = {x, y};
  combine(2, factors, vectors, result);
}

void scale(realtype factor, N_Vector x, N_Vector result) { combine(1, &factor, &x, result); }

realtype weighted_norm(N_Vector x, N_Vector weights) {
  const realtype *const at = N_VGetArrayPointer(x), *const w = N_VGetArrayPointer(weights);
  const sunindextype size = N_VGetLength(x);
  realtype sum = 0;
  for (sunindextype i = 0; i < size; ++i) sum += (at[i] * w[i]) * (at[i] * w[i]);
  return std::sqrt(sum / static_cast<realtype>(size));
}

void optimise(N_Vector vector) {
  vector->ops->nvlinearcombination = combine;
  vector->ops->nvlinearsum = add_two;
  vector->ops->nvscale = scale;
  vector->ops->nvwrmsnorm = weighted_norm;
}

// Everything that one run holds.
class Session {
 public:
  Session(PeerSystem& system, std::vector<double>& state) {
    PLIANT_EXPECT(SUNContext_Create(nullptr, &context_) == 0);
    state_ = N_VMake_Serial(static_cast<sunindextype>(state.size()), state.data(), context_);
    optimise(state_);
    memory_ = ERKStepCreate(rates_of, 0, state_, context_);
    PLIANT_EXPECT(memory_ != nullptr);
    ERKStepSetUserData(memory_, &system);
    ERKStepSetErrHandlerFn(memory_, say_nothing, nullptr);
    ERKStepSetMaxNumSteps(memory_, -1);       // no limit
    ERKStepSetInterpolantDegree(memory_, 1);  // nothing is interpolated, and a higher degree evaluates forces for it
  }
  ~Session() {
    ERKStepFree(&memory_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void choose(Table which) {
    ARKodeButcherTable table = which == pliants_vern8 ? table_of(find_integrator("vern8")) : ARKodeButcherTable_LoadERK(which);
    mend(table);
    PLIANT_EXPECT(ERKStepSetTable(memory_, table) == 0);  // copies it
    ARKodeButcherTable_Free(table);
  }
  void fix_step(double step) { ERKStepSetFixedStep(memory_, step); }
  void set_tolerance(double relative, double absolute) { ERKStepSStolerances(memory_, relative, absolute); }

  /// False where it fails.
  bool evolve(double duration) {
    double reached = 0;
    ERKStepSetStopTime(memory_, duration);
    return ERKStepEvolve(memory_, duration, state_, &reached, ARK_NORMAL) >= 0;
  }

 private:
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  void* memory_ = nullptr;
};

double integrate(PeerSystem& system, std::vector<double>& state, double duration, double effort, Table table, bool adaptive) {
  Session session(system, state);
  session.choose(table);
  if (adaptive)
    session.set_tolerance(effort, effort * size_of_numbers(state));
  else
    session.fix_step(duration / effort);
  Stopwatch watch;
  if (!watch.time([&] { return session.evolve(duration); })) std::ranges::fill(state, std::numeric_limits<double>::quiet_NaN());
  return watch.seconds();
}

void add(std::vector<PeerMethod>& methods, const char* name, Table table, double largest_step) {
  for (const bool adaptive : {false, true})
    methods.push_back({.library = "ARKODE",
                       .name = name,
                       .adaptive = adaptive,
                       .largest_step = largest_step,
                       .integrate = [=](PeerSystem& system, std::vector<double>& state, double duration, double effort) {
                         return integrate(system, state, duration, effort, table, adaptive);
                       }});
}

}  // namespace

std::vector<PeerMethod> arkode_methods() {
  std::vector<PeerMethod> methods;
  add(methods, "dormand_prince_7_4_5", ARKODE_DORMAND_PRINCE_7_4_5, 2);
  add(methods, "verner_8_5_6", ARKODE_VERNER_8_5_6, 2);
  add(methods, "fehlberg_13_7_8", ARKODE_FEHLBERG_13_7_8, 3);
  add(methods, "with pliant's vern8", pliants_vern8, 3);
  return methods;
}
#else
std::vector<PeerMethod> arkode_methods() { return {}; }
#endif

}  // namespace pliant::bench
