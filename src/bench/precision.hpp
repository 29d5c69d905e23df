// The suite `precision`: what an error costs. Every integrator runs at many step sizes on every device and in every precision,
// and so do other libraries' integrators on the same forces.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/place.hpp"

namespace pliant::bench {

struct PrecisionOptions {
  Selection devices;
  std::filesystem::path scenes = "scenes";  // folder with the bunny
  bool quick = false;
};

/// One run. The members' names are the keys of the file.
struct PrecisionRow {
  std::string case_name;  // key: case
  std::string library;    // "pliant", "ARKODE" or "odeint"
  std::string method;
  bool adaptive = false;  // the library chose its steps by `tolerance`
  std::string device = "cpu";
  int precision = 64;
  unsigned threads = 1;             // of the CPU; null in the file for the GPU
  double tolerance = 0;             // null in the file for fixed steps
  double step = 0;                  // omega times the fixed step [rad]; null in the file for adaptive steps
  std::uint64_t evaluations = 0;    // of all forces of a body
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
  double duration = 0;         // [s]
  double omega = 0;            // [rad/s]
  double reference_step = 0;   // omega times the step of the reference, vern8 in fp64 [rad]
  double reference_error = 0;  // its distance from one with steps twice as long: errors below this can't be told
  bool is_contest = false;     // whether it belongs to the comparison with other libraries
};

struct PrecisionResult {
  std::vector<PrecisionCaseInfo> cases;
  std::vector<PrecisionRow> rows;
  std::vector<std::string> notes;
  bool interrupted = false;  // by Progress
};

/// Steps are shortened until an error stops falling, cannot be told any more, or would take too long. Throws Error.
[[nodiscard]] PrecisionResult bench_precision(const PrecisionOptions& options, const Progress& progress);

}  // namespace pliant::bench
