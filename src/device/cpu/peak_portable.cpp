// Multiply-adds in vectors of 16 bytes, which every processor has or the compiler takes apart.
#include "device/cpu/peak_chains.hpp"

namespace pliant::cpu {
namespace {

constexpr unsigned vector_bytes = 16;

}  // namespace

#include "device/cpu/peak_chains.inc"

float run_chains_portable(const PeakTask<float>& task) { return run_chains(task); }
double run_chains_portable(const PeakTask<double>& task) { return run_chains(task); }

}  // namespace pliant::cpu
