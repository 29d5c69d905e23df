// The suite `forces`. It measures spring forces of one body by size, device, precision and variant, and compares them with what
// the arithmetic units allow.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

struct ForcesOptions {
  Selection devices;
  bool quick = false;
  bool all_variants = false;  // every variant of a device, instead of the GPU's best for each size
};

/// The members' names are the keys of the file.
struct ForcesRow {
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  unsigned threads = 1;  // of the CPU; null in the file for the GPU
  std::string isa;       // instruction set; "opengl" on the GPU
  std::string form;      // of the spring's formula
  std::string variant;
  std::uint32_t vertices = 0;
  double seconds_per_evaluation = 0;  // time to sum all forces: the median over the batches
  double fastest_seconds_per_evaluation = 0;
  double pairs_per_second = 0;        // by the median; an evaluation has N (N - 1) pairs
  double bound_pairs_per_second = 0;  // see spring_cost.hpp
  double ratio_to_bound = 0;
  double multiply_adds_per_second = 0;  // measured in the same run
};

struct ForcesResult {
  std::vector<ForcesRow> rows;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// Leaves out sizes that would take over 2 s an evaluation, with a note. Throws Error (device).
[[nodiscard]] ForcesResult bench_forces(const ForcesOptions& options, const Progress& progress);

}  // namespace pliant::bench
