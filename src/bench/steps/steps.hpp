// The suite `steps`: what a step of whole scenes costs, on the CPU and on the GPU, and from which size on the GPU is ahead.
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
  std::filesystem::path scenes = "scenes";  // folder
  bool quick = false;
};

/// The members' names are the keys of the file.
struct StepsRow {
  std::string scene;
  std::string family;  // of scenes that differ by their density alone; empty for a scene as it is
  std::string device;
  int precision = 32;
  unsigned threads = 1;        // of the CPU; null in the file for the GPU
  std::uint32_t vertices = 0;  // of all bodies
  std::uint32_t bodies = 0;
  double milliseconds_per_step = 0;  // the median over the runs, which follow a step that builds the kernels
  double fastest_milliseconds_per_step = 0;
  double steps_per_second = 0;      // by the median
  std::uint64_t steps = 0;          // measured, of each run
  std::uint64_t contact_steps = 0;  // among them, with a contact
  int runs = 0;                     // up to five within 1.5 s (0.3 s with `quick`), at least one
};

/// Of one family: the GPU against the CPU on so many threads.
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

/// A run that would take over a minute is left out, with a note. `quick` makes the same steps, warm as well; it leaves out what
/// takes over a second, and crossovers. Throws Error.
[[nodiscard]] StepsResult bench_steps(const StepsOptions& options, const Progress& progress);

/// For every family, and every number of threads of the CPU in it; empty without rows of the GPU.
[[nodiscard]] std::vector<FamilyCrossover> find_crossovers(const std::vector<StepsRow>& rows);

}  // namespace pliant::bench
