#include "app/bench_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "app/choose_device.hpp"
#include "bench/report.hpp"
#include "core/error.hpp"
#include "output/file.hpp"

namespace pliant::app {
namespace {

bench::Selection selection_of(const BenchOptions& options) {
  if (options.gpu_index && options.devices == BenchDevices::cpu)
    throw Error(ErrorKind::command_line, "--gpu", "does not go with --device cpu", "leave one of them out");
  const bool automatic = options.devices == BenchDevices::automatic;
  return {.cpu = options.devices != BenchDevices::gpu,
          .gpu = automatic ? options.gpu_index || has_hardware_gpu() : options.devices != BenchDevices::cpu,
          .gpu_index = options.gpu_index.value_or(0),
          .threads = options.threads};
}

void show_progress(double done, std::string_view next) {
  if (isatty(fileno(stderr)) == 0) return;
  fmt::print(stderr, "\r[{:<30}] {:3.0f} %  {:<50}", std::string(static_cast<std::size_t>(30 * done), '#'), 100 * done, next);
  if (done == 1) fmt::print(stderr, "\r{:90}\r", "");
}

// The file is opened first: minutes of measuring should not end with a folder that can't be written.
template <class Measure>
void measure_and_write(const BenchOptions& options, const Measure& measure) {
  std::optional<OutputFile> file;
  if (!options.json.empty()) file.emplace(options.json);
  const bench::Machine machine = bench::describe_machine(options.gpu_index.value_or(0));
  fmt::print("{}\n", bench::to_text(machine));
  std::fflush(stdout);  // before minutes of measuring
  const auto result = measure();
  fmt::print("{}", bench::to_table(result));
  if (!file) return;
  file->write(bench::to_json(machine, result));
  file->close();
}

}  // namespace

void bench_forces(const BenchOptions& options) {
  const bench::Selection devices = selection_of(options);
  measure_and_write(options, [&] {
    return bench::bench_forces({.devices = devices, .quick = options.quick, .all_variants = options.all_variants}, show_progress);
  });
}

void bench_steps(const BenchOptions& options) {
  const bench::Selection devices = selection_of(options);
  measure_and_write(options, [&] {
    return bench::bench_steps({.devices = devices, .scenes = options.scenes, .quick = options.quick}, show_progress);
  });
}

}  // namespace pliant::app
