#include "bench/common/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/cpu/cpu_device.hpp"
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
  Machine machine{.version = version(),
                  .commit = commit(),
                  .cpu = cpu::device_name(),
                  .cpu_threads = thread_count(0),
                  .gpu = {},
                  .driver = {},
                  .compiler = compiler(),
                  .date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))};
  for (const gl::Adapter& adapter : gl::list_adapters())
    if (adapter.index == gpu_index) {
      machine.gpu = adapter.renderer;
      machine.driver = adapter.version;
    }
  return machine;
}

std::string to_text(const Machine& machine) {
  std::string text = fmt::format("pliant {} (commit {}), {}, {}\n{}, {} threads", machine.version, machine.commit,
                                 machine.compiler, machine.date, machine.cpu, machine.cpu_threads);
  if (machine.gpu) text += fmt::format("; {}, {}", *machine.gpu, machine.driver.value_or(""));
  return text;
}

}  // namespace pliant::bench
