// Multiply-adds in vectors of 32 bytes.
#if defined(__AVX2__) && defined(__FMA__)
#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

constexpr unsigned vector_bytes = 32;

}  // namespace

#include "device/cpu/peak_chains.inc"

float run_chains_avx2(const PeakTask<float>& task) { return run_chains(task); }
double run_chains_avx2(const PeakTask<double>& task) { return run_chains(task); }

}  // namespace pliant::cpu
#endif
