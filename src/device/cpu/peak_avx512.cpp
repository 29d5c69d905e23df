// Multiply-adds in vectors of 64 bytes.
#if defined(__AVX512F__)
#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

constexpr unsigned vector_bytes = 64;

}  // namespace

#include "device/cpu/peak_chains.inc"

float run_chains_avx512(const PeakTask<float>& task) { return run_chains(task); }
double run_chains_avx512(const PeakTask<double>& task) { return run_chains(task); }

}  // namespace pliant::cpu
#endif
