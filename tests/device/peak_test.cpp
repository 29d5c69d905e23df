#include "device/cpu/peak.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

struct Chains {
  Isa isa;
  float (*in_floats)(const PeakTask<float>&);
  double (*in_doubles)(const PeakTask<double>&);
};

// The chains that run on this machine, the portable ones first.
std::vector<Chains> available_chains() {
  std::vector<Chains> all;
  for (const Isa isa : available_isas()) {
    if (isa == Isa::portable) all.push_back({isa, run_chains_portable, run_chains_portable});
#ifdef __x86_64__
    if (isa == Isa::avx2) all.push_back({isa, run_chains_avx2, run_chains_avx2});
    if (isa == Isa::avx512) all.push_back({isa, run_chains_avx512, run_chains_avx512});
#endif
  }
  return all;
}

// Counts the multiply-adds of a round: each adds 1, ten rounds long.
template <class Real>
double multiply_adds_of_round(Real (*run)(const PeakTask<Real>&)) {
  return (run({Real(1), Real(1), 10}) - run({Real(1), Real(1), 0})) / 10;
}

TEST_CASE("the chains that the peak is measured with do every multiply-add, and tend to addend / (1 - factor)") {
  for (const Chains& chains : available_chains()) {
    CHECK(multiply_adds_of_round(chains.in_floats) >= 4 * chain_count);
    CHECK(multiply_adds_of_round(chains.in_floats) == 2 * multiply_adds_of_round(chains.in_doubles));
    CHECK(chains.in_floats({0.75f, 0.5f, 1000}) == Approx(2 * multiply_adds_of_round(chains.in_floats)));
    CHECK(chains.in_doubles({0.75, 0.5, 1000}) == Approx(2 * multiply_adds_of_round(chains.in_doubles)));
  }
}

TEST_CASE("the multiply-adds of a peak are as many as its chains do, whole rounds of them") {
  ThreadPool pool(2);
  const std::vector<Chains> all = available_chains();
  const double rounds =
      static_cast<double>(run_multiply_adds(pool, Isa::portable, 32)) / multiply_adds_of_round(all[0].in_floats);
  CHECK(rounds == std::floor(rounds));
  for (const Chains& chains : all) {
    CHECK(static_cast<double>(run_multiply_adds(pool, chains.isa, 32)) == rounds * multiply_adds_of_round(chains.in_floats));
    CHECK(static_cast<double>(run_multiply_adds(pool, chains.isa, 64)) == rounds * multiply_adds_of_round(chains.in_doubles));
  }
}

}  // namespace
}  // namespace pliant::cpu
