#include "bench/peers/peers.hpp"

#ifdef PLIANT_SUNDIALS
#include <sundials/sundials_version.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/peers/sundials.hpp"
#include "core/expect.hpp"

namespace pliant::bench {
namespace {

// Sets result = change(x), number by number. `result` may be `x`.
template <class Change>
void transform(N_Vector x, N_Vector result, Change change) {
  const realtype* const from = N_VGetArrayPointer(x);
  std::transform(from, from + N_VGetLength(x), N_VGetArrayPointer(result), change);
}

void scale(realtype factor, N_Vector x, N_Vector result) {
  transform(x, result, [factor](realtype number) { return factor * number; });
}

void add_constant(N_Vector x, realtype constant, N_Vector result) {
  transform(x, result, [constant](realtype number) { return number + constant; });
}

void take_absolute(N_Vector x, N_Vector result) {
  transform(x, result, [](realtype number) { return std::abs(number); });
}

void invert(N_Vector x, N_Vector result) {
  transform(x, result, [](realtype number) { return 1 / number; });
}

void add_two(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector result) {
  const realtype* const first = N_VGetArrayPointer(x);
  std::transform(first, first + N_VGetLength(x), N_VGetArrayPointer(y), N_VGetArrayPointer(result),
                 [a, b](realtype p, realtype q) { return a * p + b * q; });
}

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
    std::copy_n(sum, length, to + first);  // after all terms, because the result may be one of them
  }
  return 0;
}

realtype weighted_norm(N_Vector x, N_Vector weights) {
  const realtype *const at = N_VGetArrayPointer(x), *const w = N_VGetArrayPointer(weights);
  const sunindextype size = N_VGetLength(x);
  realtype sum = 0;
  for (sunindextype i = 0; i < size; ++i) sum += (at[i] * w[i]) * (at[i] * w[i]);
  return std::sqrt(sum / static_cast<realtype>(size));
}

// Replaces all operations that a step or an error estimate uses.
void optimise(_generic_N_Vector_Ops& operations) {
  operations.nvlinearcombination = combine;
  operations.nvlinearsum = add_two;
  operations.nvscale = scale;
  operations.nvaddconst = add_constant;
  operations.nvabs = take_absolute;
  operations.nvinv = invert;
  operations.nvwrmsnorm = weighted_norm;
}

}  // namespace

SundialsState::SundialsState(std::vector<double>& numbers) {
  expect_success(SUNContext_Create(nullptr, &context_));
  vector_ = N_VMake_Serial(static_cast<sunindextype>(numbers.size()), numbers.data(), context_);
  PLIANT_EXPECT(vector_ != nullptr);
  optimise(*vector_->ops);
}

SundialsState::~SundialsState() {
  N_VDestroy(vector_);
  SUNContext_Free(&context_);
}

int sundials_rates(realtype, N_Vector y, N_Vector rates, void* system) {
  static_cast<PeerSystem*>(system)->rates(N_VGetArrayPointer(y), N_VGetArrayPointer(rates));
  return 0;
}

void say_nothing(int, const char*, const char*, char*, void*) {}

void expect_success(int flag) { PLIANT_EXPECT(flag == 0); }

std::string sundials_version() {
  std::array<char, 32> text{};
  expect_success(SUNDIALSGetVersion(text.data(), static_cast<int>(text.size())));
  return text.data();
}

}  // namespace pliant::bench
#else
namespace pliant::bench {
std::string sundials_version() { return {}; }
}  // namespace pliant::bench
#endif
