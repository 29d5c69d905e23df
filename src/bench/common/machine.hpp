// Describes the machine and the build that a result belongs to.
#pragma once
#include <optional>
#include <string>

namespace pliant::bench {

struct Machine {
  std::string version, commit;  // of pliant; a commit with changed files ends in "-dirty", and it may be "unknown"
  std::string cpu;
  unsigned cpu_threads = 1;
  std::optional<std::string> gpu, driver;  // OpenGL's renderer and version; empty: there is no OpenGL 4.5
  std::string compiler;                    // name and version
  std::string date;                        // UTC, ISO 8601
};

/// `gpu_index` is an index of gl::list_adapters().
[[nodiscard]] Machine describe_machine(int gpu_index);

/// Returns two lines for the top of a table: the build, and the hardware.
[[nodiscard]] std::string to_text(const Machine& machine);

}  // namespace pliant::bench
