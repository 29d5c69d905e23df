// The suite `precision`: what an error costs. Every integrator runs at many step sizes on every device and in every precision,
// those that "auto" takes for a tolerance also at many of these, and so do other libraries' integrators on the same forces.
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
  std::string device = "cpu";
  int precision = 64;
  unsigned threads = 1;             // of the CPU; null in the file for the GPU
  double tolerance = 0;             // null in the file for fixed steps
  double step = 0;                  // omega times the fixed step [rad]; null in the file for adaptive steps
  std::uint64_t evaluations = 0;    // of all forces of a body, those of rejected steps included
  std::uint64_t contact_steps = 0;  // steps with a contact
  double seconds = 0;               // of integrating: the median over the runs
  double fastest_seconds = 0;
  int runs = 0;
  double error = 0;  // at the end, see relative_error()
};

/// What rows of one name have in common.
struct PrecisionCaseInfo {
  std::string name;
  std::uint32_t vertices = 0, bodies = 0;
  std::string damping_law;
  double duration = 0;          // [s]
  double omega = 0;             // [rad/s]
  double reference_step = 0;    // omega times the step of the reference, vern8 in fp64 [rad]
  double reference_error = 0;   // its distance from one with steps twice as long: errors below this can't be told
  bool is_contest = false;      // whether it belongs to the comparison with other libraries
  bool is_complete = false;     // else it was interrupted, and nobody has won
  double seconds_of_rates = 0;  // that other libraries' systems take for one evaluation; 0 where they take no part [s]
};

struct PrecisionResult {
  std::vector<PrecisionCaseInfo> cases;
  std::vector<PrecisionRow> rows;
  std::map<std::string, std::string> versions = {};  // of other libraries' packages
  std::vector<std::string> notes;
  bool interrupted = false;  // by Progress
};

/// Steps are shortened from the longest stable ones on and tolerances sharpened from 1e-2 on, until an error stops falling,
/// cannot be told any more, or would take too long. Ends with errors above 0.1 are no rows. Throws Error.
[[nodiscard]] PrecisionResult bench_precision(const PrecisionOptions& options, const Progress& progress);

}  // namespace pliant::bench
