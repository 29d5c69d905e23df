// Chains of multiply-adds, once for each instruction set. Files that include this header are compiled for different processors,
// so it holds only declarations.
#pragma once

namespace pliant::cpu {

/// What one thread does: it computes v = v factor + addend `rounds` times in each of chain_count vectors.
template <class Real>
struct PeakTask {
  Real factor, addend;
  unsigned rounds;
};

/// Enough to hide a multiply-add's latency: two units with four or five cycles each.
inline constexpr unsigned chain_count = 12;

/// Each returns the sum of its chains, so that no compiler leaves them out.
float run_chains_portable(const PeakTask<float>& task);
double run_chains_portable(const PeakTask<double>& task);
float run_chains_avx2(const PeakTask<float>& task);
double run_chains_avx2(const PeakTask<double>& task);
float run_chains_avx512(const PeakTask<float>& task);
double run_chains_avx512(const PeakTask<double>& task);

}  // namespace pliant::cpu
