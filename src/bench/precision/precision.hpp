// The suite `precision` measures what an error costs. Every integrator runs at many step sizes on every device and in every
// precision. Those that "auto" takes for a tolerance also run at many tolerances. Other libraries' integrators do the same on the
// same forces.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

struct PrecisionOptions {
  Selection devices;
  std::filesystem::path scenes = "scenes";  // folder with the bunny
  bool quick = false;
};

/// One run. The members' names are the keys of the file.
struct PrecisionRow {
  std::string case_name;  // key: case
  std::string library;    // "pliant" or one of peer_libraries
  std::string method;
  bool adaptive = false;  // the library chose its steps by `tolerance`
  DeviceKind device = DeviceKind::cpu;
  int precision = 64;
  unsigned threads = 1;             // of the CPU; null in the file for the GPU
  double tolerance = 0;             // null in the file for fixed steps
  double step = 0;                  // omega times the fixed step [rad]; null in the file for adaptive steps
  std::uint64_t evaluations = 0;    // of all forces of a body, including those of rejected steps
  std::uint64_t contact_steps = 0;  // steps with a contact
  double seconds = 0;               // time to integrate: the median over the runs
  double fastest_seconds = 0;
  int runs = 0;
  double error = 0;  // at the end, see relative_error()
};

/// The values that all rows of a case have in common.
struct PrecisionCaseInfo {
  std::string name;
  std::uint32_t vertices = 0, bodies = 0;
  std::string damping_law;
  double duration = 0;          // [s]
  double omega = 0;             // [rad/s]
  double reference_step = 0;    // omega times the step of the reference, vern8 in fp64 [rad]
  double reference_error = 0;   // distance to a reference with steps twice as long (smaller errors can't be measured)
  bool is_contest = false;      // it belongs to the comparison with other libraries
  bool is_complete = false;     // false: it was interrupted, and nobody has won
  double seconds_of_rates = 0;  // time of one evaluation by other libraries' systems [s]; 0: they take no part
};

struct PrecisionResult {
  std::vector<PrecisionCaseInfo> cases;
  std::vector<PrecisionRow> rows;
  std::map<std::string, std::string> versions = {};  // of other libraries' packages
  std::vector<std::string> notes;
  bool interrupted = false;  // by Progress
};

/// Runs the suite. Steps become shorter, beginning with the longest stable ones, and tolerances smaller, beginning with 1e-2. A
/// method ends when its error stops falling or can't be measured, or when the next run would take too long. Runs with errors
/// above 0.1 give no row. Throws Error.
[[nodiscard]] PrecisionResult bench_precision(const PrecisionOptions& options, const Progress& progress);

}  // namespace pliant::bench
