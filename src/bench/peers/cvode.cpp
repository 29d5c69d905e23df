// Runs SUNDIALS CVODE's Adams methods of orders 1 to 12 with functional iteration. A tolerance governs steps and orders.
#include "bench/peers/peers.hpp"

#ifdef PLIANT_SUNDIALS
#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <limits>

#include "bench/peers/sundials.hpp"
#include "core/expect.hpp"
#include "core/stopwatch.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_SUNDIALS
namespace {

// Everything that one run holds.
class Session {
 public:
  Session(PeerSystem& system, std::vector<double>& numbers, double tolerance)
      : state_(numbers),
        memory_(CVodeCreate(CV_ADAMS, state_.context())),
        solver_(SUNNonlinSol_FixedPoint(state_.vector(), 0, state_.context())) {
    PLIANT_EXPECT(memory_ != nullptr && solver_ != nullptr);
    expect_success(CVodeInit(memory_, sundials_rates, 0, state_.vector()));
    expect_success(CVodeSetUserData(memory_, &system));
    expect_success(CVodeSetErrHandlerFn(memory_, say_nothing, nullptr));
    expect_success(CVodeSetMaxNumSteps(memory_, -1));  // no limit
    expect_success(CVodeSetNonlinearSolver(memory_, solver_));
    expect_success(CVodeSStolerances(memory_, tolerance, tolerance * size_of_numbers(numbers)));
  }
  ~Session() {
    CVodeFree(&memory_);
    SUNNonlinSolFree(solver_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void end_at(double time) { expect_success(CVodeSetStopTime(memory_, time)); }

  /// Returns false if it fails.
  bool evolve(double end) {
    double reached = 0;
    return CVode(memory_, end, state_.vector(), &reached, CV_NORMAL) >= 0;
  }

 private:
  SundialsState state_;
  void* memory_;
  SUNNonlinearSolver solver_;
};

double integrate(PeerSystem& system, std::vector<double>& state, double duration, double tolerance) {
  Session session(system, state, tolerance);
  session.end_at(duration);
  Stopwatch watch;
  if (!watch.time([&] { return session.evolve(duration); })) std::ranges::fill(state, std::numeric_limits<double>::quiet_NaN());
  return watch.seconds();
}

}  // namespace

std::vector<PeerMethod> cvode_methods() {
  return {{.library = "CVODE", .name = "Adams", .adaptive = true, .integrate = integrate}};
}
#else
std::vector<PeerMethod> cvode_methods() { return {}; }
#endif

}  // namespace pliant::bench
