#include "run/info.hpp"

#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/cpu/cpu_device.hpp"
#include "device/cpu/spring_sums.hpp"

namespace pliant {
namespace {

constexpr const char* what_gpus_need =
    "GPU runs and PNG frames need an OpenGL 4.5 driver with EGL (Debian: libegl1 and libgl1-mesa-dri, or NVIDIA's driver); "
    "--device cpu runs without";

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

}  // namespace

Gpus find_gpus() {
  std::string reason;
  const std::vector<gl::Adapter> adapters = gl::list_adapters(&reason);
  return {adapters, adapters.empty() ? reason + "; " + what_gpus_need : ""};
}

std::string_view damping_of(const Integrator& integrator) {
  if (allows_damping(integrator, DampingLaw::adaptive)) return "any";
  return allows_damping(integrator, DampingLaw::constant) ? "constant" : "none";
}

Json info(const Gpus& gpus) {
  Json result = {{"version", version()},
                 {"cpu", described_cpu()},
                 {"gpus", list_of(gpus.adapters, [](const gl::Adapter& gpu) { return described(gpu); })}};
  if (!gpus.missing.empty()) result.add("missing", gpus.missing);
  return result;
}

Json info_of_integrators() {
  return list_of(integrators(), [](const Integrator& row) { return described(row); });
}

}  // namespace pliant
