// The suite `drops`. Soft bodies fall on a floor: how long that takes, and what becomes of space, volume, energy and momentum.
// Beside Bullet's soft bodies.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

struct DropsOptions {
  Selection devices;
  std::filesystem::path scenes = "scenes";  // the bunny lies beside this folder, in meshes
  bool quick = false;                       // a tenth of the time, without the bunny
};

/// The members' names are the keys of the file. What is deep, small or made is the worst at any of 60 looks a second.
struct DropRow {
  std::string drop;    // "sphere", "bunny" or "stack of ten"
  std::string engine;  // "pliant, verlet", "pliant, cv8", or a library and its version
  DeviceKind device = DeviceKind::cpu;
  unsigned threads = 1;             // of the CPU; null in the file for the GPU
  std::uint32_t vertices = 0;       // of all bodies
  double time_step = 0;             // [s]
  double seconds_per_second = 0;    // real time of stepping over simulated time
  std::uint64_t intersections = 0;  // pairs of triangles of two bodies that touch, summed over all looks
  double depth = 0;                 // of a vertex below the floor [m]
  double least_volume = 1;          // of a body, over that at rest
  double most_energy = 0;           // of motion and height, less that at the start, over what a fall to the floor gives
  double sideways = 0;              // momentum along the floor, over what the fall gives a body
  double last_height = 1;           // of the highest body's centre at the end, over that at the start
};

struct DropsResult {
  std::vector<DropRow> rows;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// Throws Error: device, or input if the bunny's mesh is missing.
[[nodiscard]] DropsResult bench_drops(const DropsOptions& options, const Progress& progress);

}  // namespace pliant::bench
