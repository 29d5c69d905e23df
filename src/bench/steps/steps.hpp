// The suite `steps` measures what a step of whole scenes costs on the CPU and on the GPU. It also finds the size from which on
// the GPU is ahead.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/place.hpp"
#include "bench/steps/crossover.hpp"

namespace pliant::bench {

struct StepsOptions {
  Selection devices;
  std::filesystem::path scenes = "scenes";  // folder of scenes
  bool quick = false;
};

/// The members' names are the keys of the file.
struct StepsRow {
  std::string scene;
  std::string family;  // name of cases that differ only by their density; empty for a scene as it is
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  unsigned threads = 1;        // of the CPU; null in the file for the GPU
  std::uint32_t vertices = 0;  // of all bodies
  std::uint32_t bodies = 0;
  std::uint32_t clustered_bodies = 0;  // whose springs are summed by clusters
  double milliseconds_per_step = 0;    // the median over the runs, which follow a step that builds the kernels
  double fastest_milliseconds_per_step = 0;
  double steps_per_second = 0;      // by the median
  std::uint64_t steps = 0;          // measured steps of each run
  std::uint64_t contact_steps = 0;  // measured steps with a contact
  int runs = 0;                     // up to five within 1.5 s (0.3 s with `quick`), at least one
};

/// Compares the GPU with the CPU on so many threads in one family.
struct FamilyCrossover {
  std::string family;
  unsigned threads = 1;
  Crossover crossover;
};

struct StepsResult {
  std::vector<StepsRow> rows;
  std::vector<FamilyCrossover> crossovers;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// Runs the suite. It leaves out a run that would take over a minute by the pace of its first steps, with a note. With `quick` it
/// makes the same warm steps, but leaves out runs that take over a second, and crossovers. Throws Error.
[[nodiscard]] StepsResult bench_steps(const StepsOptions& options, const Progress& progress);

/// Returns a crossover for every family and every number of threads of the CPU in it. Without rows of the GPU there is none.
[[nodiscard]] std::vector<FamilyCrossover> find_crossovers(const std::vector<StepsRow>& rows);

}  // namespace pliant::bench
