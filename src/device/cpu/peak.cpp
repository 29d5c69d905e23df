#include "device/cpu/peak.hpp"

#include <atomic>

#include "core/expect.hpp"
#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

constexpr unsigned rounds = 1u << 14;
constexpr std::uint32_t tasks_per_thread = 4;

std::atomic<double> last_sum;  // keeps the chains from being left out

template <class Real>
Real run_chains(Isa isa, const PeakTask<Real>& task) {
#ifdef PLIANT_X86_TILES
  if (isa == Isa::avx512) return run_chains_avx512(task);
  if (isa == Isa::avx2) return run_chains_avx2(task);
#endif
  PLIANT_EXPECT(isa == Isa::portable);
  return run_chains_portable(task);
}

template <class Real>
void run_on_all(ThreadPool& pool, Isa isa) {
  const PeakTask<Real> task{Real(0.75), Real(0.5), rounds};  // chains tend to 2: no denormal and no infinite number
  pool.for_ranges(pool.size() * tasks_per_thread, 1, [&](std::uint32_t, std::uint32_t) {
    last_sum.store(static_cast<double>(run_chains(isa, task)), std::memory_order_relaxed);
  });
}

std::uint64_t lanes_of(Isa isa, int precision) {
  const std::uint64_t bytes = isa == Isa::avx512 ? 64 : isa == Isa::avx2 ? 32 : 16;
  return 8 * bytes / static_cast<std::uint64_t>(precision);
}

}  // namespace

std::uint64_t run_multiply_adds(ThreadPool& pool, Isa isa, int precision) {
  PLIANT_EXPECT(precision == 32 || precision == 64);
  if (precision == 32)
    run_on_all<float>(pool, isa);
  else
    run_on_all<double>(pool, isa);
  return lanes_of(isa, precision) * chain_count * rounds * tasks_per_thread * pool.size();
}

bool fuses_multiply_adds(Isa isa) {
#ifdef __FP_FAST_FMAF
  constexpr bool everywhere = true;
#else
  constexpr bool everywhere = false;
#endif
  return everywhere || isa != Isa::portable;
}

}  // namespace pliant::cpu
