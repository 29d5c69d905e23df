// `pliant bench`: measures this machine and gives the results as a table and as JSON.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace pliant::app {

/// The devices to measure. `automatic` means the CPU, and a hardware GPU if there is one. `all` means both, even if the GPU is in
/// software.
enum class BenchDevices { automatic, cpu, gpu, all };

enum class BenchSuite { forces, steps, precision, stability, contact, collision, drops, draw, dense };

/// What the suite contact is made of (bench/contact/contact.hpp).
enum class BenchStudy { all, apart, impacts, rest, cost, self };

struct BenchOptions {
  BenchSuite suite = BenchSuite::forces;
  BenchDevices devices = BenchDevices::automatic;
  std::optional<int> gpu_index;                   // of gl::list_adapters()
  unsigned threads = 0;                           // most threads of the CPU; 0: one a processor
  std::filesystem::path json;                     // empty: no file
  bool quick = false;                             // figures of the right size in a few seconds
  bool all_variants = false;                      // forces: every way of summing that a device knows
  BenchStudy only = BenchStudy::all;              // contact: one study alone
  std::filesystem::path scenes = "scenes";        // steps, precision, contact, draw: folder of scenes
  std::array<std::uint32_t, 2> size{1920, 1080};  // draw: size of the picture [pixels]
};

/// Prints the machine and a table, and writes the file. An earlier file stays until then. After Ctrl-C (interrupts.hpp) both hold
/// the rows that are finished. Returns the exit code, 0 or exit_interrupted. Throws Error, of kind device where this program was
/// built without benchmarks.
int bench(const BenchOptions& options);

}  // namespace pliant::app
