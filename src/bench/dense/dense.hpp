// The suite `dense`. It measures springs of a clustered body: how large their errors are for how many springs, and how long a sum
// of them takes, and a step, beside those of all springs.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

struct DenseOptions {
  Selection devices;
  std::filesystem::path scenes = "scenes";  // the bunny lies beside this folder, in meshes
  bool quick = false;
};

/// The members' names are the keys of the file.
struct DenseErrorRow {
  std::string mesh;
  std::uint32_t vertices = 0;
  double accuracy = 0;  // tau of pair_clusters()
  double springs_per_vertex = 0;
  std::string deformation;
  double error = 0;  // of forces on some vertices, over their size, in fp64
};

struct DenseForceRow {
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  unsigned threads = 1;  // of the CPU; null in the file for the GPU
  std::string mesh;
  std::uint32_t vertices = 0;
  double tolerance = 0;
  double list_seconds = 0;                                        // for tree and lists, on one thread of the CPU
  double seconds_per_sum = 0;                                     // median over the batches
  std::vector<std::pair<std::string, double>> pass_seconds = {};  // the same of each pass, which runs alone
  double direct_seconds_per_sum = 0;         // of all springs; 0, and null in the file, where that would take too long
  double seconds_per_step = 0;               // by cv8, which sums 11 times, with checks; 0, and null in the file, as above
  double seconds_per_contact_step = 0;       // of a body that has fallen on a ground; 0, and null in the file, as above
  std::optional<double> contact_share = {};  // of those steps, or of parts if they fall into such, that had a contact
  double direct_seconds_per_step = 0;        // the same with all springs
  double bytes_per_vertex = 0;               // of tree, lists and sums on the device
  double error = 0;  // as in a DenseErrorRow, of a body whose neighbours move apart by some percent of its size
};

struct DenseResult {
  std::vector<DenseErrorRow> rows;
  std::vector<DenseForceRow> forces;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// Throws Error (device).
[[nodiscard]] DenseResult bench_dense(const DenseOptions& options, const Progress& progress);

}  // namespace pliant::bench
