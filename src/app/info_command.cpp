#include "app/info_command.hpp"

#include <fmt/format.h>

#include "core/json.hpp"
#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/cpu/cpu_device.hpp"
#include "device/cpu/spring_sums.hpp"
#include "dynamics/integrator.hpp"
#include "gl/context.hpp"

namespace pliant::app {
namespace {

constexpr const char* remedy =
    "GPU runs and PNG frames need an OpenGL 4.5 driver with EGL (Debian: libegl1 and libgl1-mesa-dri, or NVIDIA's driver); "
    "--device cpu runs without";

std::string_view damping_of(const Integrator& integrator) {
  if (allows_damping(integrator, DampingLaw::adaptive)) return "any";
  return allows_damping(integrator, DampingLaw::constant) ? "constant" : "none";
}

Json described(const Integrator& integrator) {
  return {{"name", integrator.name},
          {"order", integrator.order},
          {"force_evaluations_per_step", evaluations_per_step(integrator)},
          {"damping", damping_of(integrator)},
          {"tolerance", estimates_error(integrator)},
          {"strained_bound", integrator.strained_bound},
          {"description", integrator.description},
          {"source", integrator.source}};
}

Json described(const gl::Adapter& adapter) {
  return {{"index", adapter.index},
          {"renderer", adapter.renderer},
          {"vendor", adapter.vendor},
          {"driver", adapter.version},
          {"software", adapter.is_software},
          {"largest_buffer_bytes", adapter.largest_buffer},
          {"storage_blocks", adapter.storage_blocks},
          {"free_memory_bytes", adapter.free_memory}};
}

Json described_cpu() {
  const auto name = [](cpu::Isa isa) { return Json(cpu::name_of(isa)); };
  return {{"name", cpu::device_name()}, {"threads", thread_count(0)}, {"instruction_sets", list_of(cpu::available_isas(), name)}};
}

struct Devices {
  std::vector<gl::Adapter> gpus;
  std::string missing;  // why there is no GPU, and what to do about it; empty: there is one
};

Devices find_devices() {
  std::string reason;
  const std::vector<gl::Adapter> gpus = gl::list_adapters(&reason);
  return {gpus, gpus.empty() ? reason + "; " + remedy : ""};
}

Json described(const Devices& devices) {
  Json result = {{"version", version()},
                 {"cpu", described_cpu()},
                 {"gpus", list_of(devices.gpus, [](const gl::Adapter& gpu) { return described(gpu); })}};
  if (!devices.missing.empty()) result.add("missing", devices.missing);
  return result;
}

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

void print_devices(const Devices& devices) {
  fmt::print("pliant {}\n", version());
  fmt::print("cpu:   {} ({} threads)\n", cpu::device_name(), thread_count(0));
  for (const gl::Adapter& gpu : devices.gpus)
    fmt::print("gpu {}: {}, driver {}, buffers up to {} MB, {} storage blocks{}{}\n", gpu.index, gpu.renderer, gpu.version,
               gpu.largest_buffer / 1000000, gpu.storage_blocks,
               gpu.free_memory > 0 ? fmt::format(", {} MB free", gpu.free_memory / 1000000) : "",
               gpu.is_software ? " (software: used only with --device gpu)" : "");
  if (!devices.missing.empty()) fmt::print("no gpu: {}\n", devices.missing);
}

void show_integrators(bool as_json) {
  if (as_json)
    fmt::print("{}\n", list_of(integrators(), [](const Integrator& row) { return described(row); }).text(2));
  else
    print_integrators();
}

void show_devices(bool as_json) {
  const Devices devices = find_devices();
  if (as_json)
    fmt::print("{}\n", described(devices).text(2));
  else
    print_devices(devices);
}

}  // namespace

void show_info(const InfoOptions& options) {
  if (options.integrators)
    show_integrators(options.json);
  else
    show_devices(options.json);
}

}  // namespace pliant::app
