// The common parts of runs of SUNDIALS's integrators. The file is empty if the build did not find SUNDIALS.
#pragma once
#ifdef PLIANT_SUNDIALS
#include <nvector/nvector_serial.h>

#include <vector>

#include "bench/peers/system.hpp"

namespace pliant::bench {

/// A state for SUNDIALS with vector operations compiled here, which clones of its vector also use. Debian builds SUNDIALS's own
/// operations without optimisation, and they would cost as much time as the forces of a small body.
class SundialsState {
 public:
  /// `numbers` must outlive it.
  explicit SundialsState(std::vector<double>& numbers);
  ~SundialsState();
  SundialsState(const SundialsState&) = delete;
  SundialsState& operator=(const SundialsState&) = delete;

  [[nodiscard]] SUNContext context() const { return context_; }
  [[nodiscard]] N_Vector vector() const { return vector_; }

 private:
  SUNContext context_ = nullptr;
  N_Vector vector_ = nullptr;
};

/// Calls PeerSystem::rates of the system that `system` points to.
int sundials_rates(realtype time, N_Vector y, N_Vector rates, void* system);
/// Ignores errors, because callers see them by a state that is not finite.
void say_nothing(int code, const char* module, const char* function, char* message, void* data);
/// Expects that SUNDIALS has taken a setting. If not, that is a bug here.
void expect_success(int flag);

}  // namespace pliant::bench
#endif
