#include "device/cpu/peak.hpp"

#include <catch2/catch.hpp>

#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

// Every chain tends to addend / (1 - factor).
template <class Real>
void check_chains(Real (*run)(const PeakTask<Real>&), unsigned vector_bytes) {
  const auto numbers = static_cast<Real>(chain_count * vector_bytes / sizeof(Real));
  CHECK(run({Real(0.75), Real(0.5), 1000}) == Approx(2 * numbers));
  CHECK(run({Real(1), Real(1), 10}) - run({Real(1), Real(1), 0}) == Approx(10 * numbers));  // every round counts
}

TEST_CASE("the chains that the peak is measured with do every multiply-add") {
  check_chains<float>(run_chains_portable, 16);
  check_chains<double>(run_chains_portable, 16);
#ifdef __x86_64__
  for (const Isa isa : available_isas()) {
    if (isa == Isa::avx2) check_chains<float>(run_chains_avx2, 32);
    if (isa == Isa::avx2) check_chains<double>(run_chains_avx2, 32);
    if (isa == Isa::avx512) check_chains<float>(run_chains_avx512, 64);
    if (isa == Isa::avx512) check_chains<double>(run_chains_avx512, 64);
  }
#endif
}

TEST_CASE("multiply-adds are counted lane by lane, on every thread") {
  ThreadPool one(1), two(2);
  for (const Isa isa : available_isas()) {
    const std::uint64_t count = run_multiply_adds(one, isa, 32);
    CHECK(count > 0);
    CHECK(run_multiply_adds(two, isa, 32) == 2 * count);
    CHECK(count == 2 * run_multiply_adds(one, isa, 64));
  }
}

}  // namespace
}  // namespace pliant::cpu
