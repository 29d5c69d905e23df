// Says where a benchmark runs: a device with its precision and threads.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.hpp"

namespace pliant::bench {

struct Place {
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  unsigned threads = 1;  // of the CPU
  int gpu_index = 0;     // of gl::list_adapters()
};

/// Opens the place's device. Throws Error (device).
[[nodiscard]] std::unique_ptr<Device> open(const Place& place);

/// Returns such as "cpu, 4 threads, fp64" or "gpu".
[[nodiscard]] std::string name_of(const Place& place);

/// What the command line asks for.
struct Selection {
  bool cpu = true;
  bool gpu = false;
  int gpu_index = 0;
  unsigned threads = 0;  // most threads of the CPU; 0: one a processor
};

/// Returns the CPU on one thread and on all threads, each with every one of `cpu_precisions`, and then the GPU.
[[nodiscard]] std::vector<Place> places_of(const Selection& selection, std::span<const int> cpu_precisions);

/// Is called with what is measured next, and with how much of the suite is done (0 to 1). If it returns false, the suite ends.
using Progress = std::function<bool(double done, std::string_view next)>;

}  // namespace pliant::bench
