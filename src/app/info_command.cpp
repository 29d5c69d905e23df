#include "app/info_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/cpu/cpu_device.hpp"
#include "device/cpu/spring_sums.hpp"
#include "dynamics/integrator.hpp"
#include "gl/context.hpp"

namespace pliant::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* remedy =
    "GPU runs and PNG frames need an OpenGL 4.5 driver with EGL (Debian: libegl1 and libgl1-mesa-dri, or NVIDIA's driver); "
    "--device cpu runs without";

std::string_view damping_of(const Integrator& integrator) {
  if (allows_damping(integrator, DampingLaw::adaptive)) return "any";
  return allows_damping(integrator, DampingLaw::constant) ? "constant" : "none";
}

Json described_integrators() {
  Json list = Json::array();
  for (const Integrator& integrator : integrators())
    list.push_back({{"name", integrator.name},
                    {"order", integrator.order},
                    {"force_evaluations_per_step", evaluations_per_step(integrator)},
                    {"damping", damping_of(integrator)},
                    {"tolerance", estimates_error(integrator)},
                    {"strained_bound", integrator.strained_bound},
                    {"description", integrator.description},
                    {"source", integrator.source}});
  return list;
}

Json described_cpu() {
  Json names = Json::array();
  for (const cpu::Isa isa : cpu::available_isas()) names.push_back(cpu::name_of(isa));
  return {{"name", cpu::device_name()}, {"threads", thread_count(0)}, {"instruction_sets", names}};
}

Json described_devices() {
  Json gpus = Json::array();
  std::string reason;
  for (const gl::Adapter& adapter : gl::list_adapters(&reason))
    gpus.push_back({{"index", adapter.index},
                    {"renderer", adapter.renderer},
                    {"vendor", adapter.vendor},
                    {"driver", adapter.version},
                    {"software", adapter.is_software},
                    {"largest_buffer_bytes", adapter.largest_buffer},
                    {"storage_blocks", adapter.storage_blocks}});
  Json result = {{"version", version()}, {"cpu", described_cpu()}, {"gpus", gpus}};
  if (gpus.empty()) result["missing"] = reason + "; " + remedy;
  return result;
}

void print_integrators(const Json& list) {
  const auto yes_or_no = [](const Json& value) { return value.get<bool>() ? "yes" : "no"; };
  fmt::print("{:<12} {:>5} {:>12} {:>9}  {:<8} {:<10} {}\n", "name", "order", "forces/step", "squashed", "damping", "tolerance",
             "description");
  for (const Json& row : list)
    fmt::print("{:<12} {:>5} {:>12} {:>9}  {:<8} {:<10} {}\n", row["name"].get<std::string>(), row["order"].get<int>(),
               row["force_evaluations_per_step"].get<int>(), row["strained_bound"].get<double>(),
               row["damping"].get<std::string>(), yes_or_no(row["tolerance"]), row["description"].get<std::string>());
  fmt::print(
      "squashed: the part of the step bound that spheres squashed to a half were measured to bear; automatic steps take 0.9 of "
      "it.\n");
  fmt::print("With a tolerance, integrator \"auto\" chooses among those that can meet one.\n");
}

void print_devices(const Json& devices) {
  fmt::print("pliant {}\n", devices["version"].get<std::string>());
  fmt::print("cpu:   {} ({} threads)\n", devices["cpu"]["name"].get<std::string>(), devices["cpu"]["threads"].get<unsigned>());
  for (const Json& gpu : devices["gpus"])
    fmt::print("gpu {}: {}, driver {}, buffers up to {} MB, {} storage blocks{}\n", gpu["index"].get<int>(),
               gpu["renderer"].get<std::string>(), gpu["driver"].get<std::string>(),
               gpu["largest_buffer_bytes"].get<std::int64_t>() / 1000000, gpu["storage_blocks"].get<unsigned>(),
               gpu["software"].get<bool>() ? " (software: used only with --device gpu)" : "");
  if (devices.contains("missing")) fmt::print("no gpu: {}\n", devices["missing"].get<std::string>());
}

}  // namespace

void show_info(const InfoOptions& options) {
  const Json content = options.integrators ? described_integrators() : described_devices();
  if (options.json)
    fmt::print("{}\n", content.dump(2));
  else if (options.integrators)
    print_integrators(content);
  else
    print_devices(content);
}

}  // namespace pliant::app
