// What runs of SUNDIALS's integrators have in common. Empty where the build did not find SUNDIALS.
#pragma once
#ifdef PLIANT_SUNDIALS
#include <nvector/nvector_serial.h>

#include <vector>

#include "bench/peers/system.hpp"

namespace pliant::bench {

/// A state for SUNDIALS, over numbers that must outlive it, with vector operations compiled here: Debian builds those of SUNDIALS
/// without optimisation, and they would cost as much time as the forces of a small body. Vectors cloned of it take them over.
class SundialsState {
 public:
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

/// PeerSystem::rates of the system that `system` points to.
int sundials_rates(realtype time, N_Vector y, N_Vector rates, void* system);
/// For errors: a state that is not finite tells them.
void say_nothing(int code, const char* module, const char* function, char* message, void* data);
/// A setting that SUNDIALS does not take is a bug here.
void expect_success(int flag);

}  // namespace pliant::bench
#endif
