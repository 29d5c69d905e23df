#include "app/info_command.hpp"

#include <fmt/format.h>

#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/cpu/cpu_device.hpp"
#include "run/info.hpp"

namespace pliant::app {
namespace {

void print_integrators() {
  fmt::print("{:<12} {:>5} {:>12} {:>9}  {:<8} {:<10} {}\n", "name", "order", "forces/step", "squashed", "damping", "tolerance",
             "description");
  for (const Integrator& row : integrators())
    fmt::print("{:<12} {:>5} {:>12} {:>9}  {:<8} {:<10} {}\n", row.name, row.order, evaluations_per_step(row), row.strained_bound,
               damping_of(row), estimates_error(row) ? "yes" : "no", row.description);
  fmt::print(
      "squashed: the part of the step bound that was measured to be stable for spheres squashed to a half. Automatic steps take "
      "0.9 of it.\n");
  fmt::print("With a tolerance, integrator \"auto\" chooses among those that can meet one.\n");
}

void print_devices(const Gpus& gpus) {
  fmt::print("pliant {}\n", version());
  fmt::print("cpu:   {} ({} threads)\n", cpu::device_name(), thread_count(0));
  for (const gl::Adapter& gpu : gpus.adapters)
    fmt::print("gpu {}: {}, driver {}, buffers up to {} MB, {} storage blocks{}{}\n", gpu.index, gpu.renderer, gpu.version,
               gpu.largest_buffer / 1000000, gpu.storage_blocks,
               gpu.free_memory > 0 ? fmt::format(", {} MB free", gpu.free_memory / 1000000) : "",
               gpu.is_software ? " (software: used only with --device gpu)" : "");
  if (!gpus.missing.empty()) fmt::print("no gpu: {}\n", gpus.missing);
}

void show_integrators(bool as_json) {
  if (as_json)
    fmt::print("{}\n", info_of_integrators().text(2));
  else
    print_integrators();
}

void show_devices(bool as_json) {
  const Gpus gpus = find_gpus();
  if (as_json)
    fmt::print("{}\n", info(gpus).text(2));
  else
    print_devices(gpus);
}

}  // namespace

void show_info(const InfoOptions& options) {
  if (options.integrators)
    show_integrators(options.json);
  else
    show_devices(options.json);
}

}  // namespace pliant::app
