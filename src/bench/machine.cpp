#include "bench/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "device/device.hpp"
#include "gl/context.hpp"

namespace pliant::bench {
namespace {

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

}  // namespace

Machine describe_machine(int gpu_index) {
  const DeviceInfo cpu = make_cpu_device(0, 32)->info();
  Machine machine{.cpu = cpu.name, .cpu_threads = cpu.threads, .gpu = {}, .driver = {}, .compiler = compiler(), .date = {}};
  machine.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  for (const gl::Adapter& adapter : gl::list_adapters())
    if (adapter.index == gpu_index) {
      machine.gpu = adapter.renderer;
      machine.driver = adapter.version;
    }
  return machine;
}

}  // namespace pliant::bench
