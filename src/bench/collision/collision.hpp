// The suite `collision`. It measures how long it takes to find all pairs of triangles that touch between two bodies, beside other
// libraries' trees, and what a step costs that answers contacts.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bench/collision/contact_step.hpp"
#include "bench/common/place.hpp"

namespace pliant::bench {

struct CollisionOptions {
  Selection devices;
  bool quick = false;
};

/// The members' names are the keys of the file.
struct CollisionRow {
  std::string engine;  // "pliant", with how its trees are split, "brute force", or a library and its version
  DeviceKind device = DeviceKind::cpu;
  unsigned threads = 1;  // of the CPU; null in the file for the GPU
  std::string overlap;   // "apart", "5 %" or "50 %"
  std::size_t bodies = 2;
  std::uint32_t triangles = 0;  // of each body
  double build_seconds = 0;     // the trees of all, on one thread; null in the file without trees
  double refit_seconds = 0;     // the median of some refits of all
  double query_seconds = 0;     // the median: all pairs whose boxes overlap, and the exact test of each
  std::uint64_t pairs = 0;      // that touch
  bool agrees = true;           // as many pairs, at the same vertices, as the first row of this size and overlap

  [[nodiscard]] double refit_and_query_seconds() const { return refit_seconds + query_seconds; }
  [[nodiscard]] double refitted_per_second() const { return refit_seconds > 0 ? double(bodies) * triangles / refit_seconds : 0; }
};

struct CollisionResult {
  std::vector<CollisionRow> rows;
  std::vector<ContactStepRow> contact_steps;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// 16 spheres of 327,680 triangles each on GPUs, or smaller ones on all devices if it is quick. Then two from 1,280 triangles
/// each to 327,680, for which all engines together take some 2 GB. They take turns. Other libraries run on one thread. A case
/// that is interrupted has no rows. Throws Error (device).
[[nodiscard]] CollisionResult bench_collision(const CollisionOptions& options, const Progress& progress);

}  // namespace pliant::bench
