#include "app/bench_command.hpp"

#include "core/error.hpp"
#ifdef PLIANT_BENCH
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "bench/collision/report.hpp"
#include "bench/common/step_cases.hpp"
#include "bench/contact/report.hpp"
#include "bench/dense/report.hpp"
#include "bench/draw/report.hpp"
#include "bench/drops/report.hpp"
#include "bench/forces/report.hpp"
#include "bench/precision/report.hpp"
#include "bench/stability/report.hpp"
#include "bench/steps/report.hpp"
#include "output/file.hpp"
#include "run/choose_device.hpp"
#include "run/interrupts.hpp"
#include "run/progress_bar.hpp"
#endif

namespace pliant::app {

#ifdef PLIANT_BENCH

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

// Returns whether to go on.
bool show_progress(double done, std::string_view next) {
  if (isatty(fileno(stderr)) == 0) return !is_interrupted();
  fmt::print(stderr, "\r{}  {:<50}", progress_bar(done), next);
  if (done == 1 || is_interrupted()) fmt::print(stderr, "\r{:90}\r", "");
  return !is_interrupted();
}

// If standard output can't be written, the program says so at its end.
void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

// Prints the table first, so that an error of writing the file does not lose it. If an interrupted suite has no rows, an earlier
// file stays.
template <class Options, class Result>
void write_results(const bench::Machine& machine, const Options& asked, const Result& result, std::optional<WholeFile>& file) {
  print(bench::to_table(result));
  const bool has_nothing = result.interrupted && result.rows.empty();
  if (result.interrupted)
    fmt::print(stderr, "pliant: interrupted after {} row{}{}\n", result.rows.size(), result.rows.size() == 1 ? "" : "s",
               file && has_nothing ? "; no file was written" : "");
  if (!file || has_nothing) return;
  file->write(bench::to_json(machine, asked, result));
  file->close();
}

// Checks the file's place first, so that minutes of measuring do not end with a folder that can't be written.
template <class Options, class Measure>
int measure_and_write(const BenchOptions& options, const Options& asked, const Measure& measure) {
  watch_for_interrupts("the measurement in hand");
  std::optional<WholeFile> file;
  if (!options.json.empty()) file.emplace(options.json);
  const bench::Machine machine = bench::describe_machine(options.gpu_index.value_or(0));
  print(bench::to_text(machine) + '\n');  // before minutes of measuring
  const auto result = measure(asked, show_progress);
  write_results(machine, asked, result, file);
  return result.interrupted ? exit_interrupted : 0;
}

int measure_forces(const BenchOptions& options) {
  const bench::ForcesOptions asked{
      .devices = selection_of(options), .quick = options.quick, .all_variants = options.all_variants};
  return measure_and_write(options, asked, bench::bench_forces);
}

int measure_steps(const BenchOptions& options) {
  bench::expect_scenes(options.scenes);
  const bench::StepsOptions asked{.devices = selection_of(options), .scenes = options.scenes, .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_steps);
}

int measure_precision(const BenchOptions& options) {
  const bench::PrecisionOptions asked{.devices = selection_of(options), .scenes = options.scenes, .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_precision);
}

int measure_stability(const BenchOptions& options) {
  const bench::StabilityOptions asked{.devices = selection_of(options), .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_stability);
}

std::optional<bench::ContactStudy> study_of(BenchStudy only) {
  switch (only) {
    case BenchStudy::all:
      break;
    case BenchStudy::apart:
      return bench::ContactStudy::apart;
    case BenchStudy::impacts:
      return bench::ContactStudy::impacts;
    case BenchStudy::rest:
      return bench::ContactStudy::rest;
    case BenchStudy::cost:
      return bench::ContactStudy::cost;
    case BenchStudy::self:
      return bench::ContactStudy::self;
  }
  return {};
}

int measure_contact(const BenchOptions& options) {
  const bench::ContactOptions asked{
      .devices = selection_of(options), .only = study_of(options.only), .scenes = options.scenes, .quick = options.quick};
  const bool reads_meshes = !asked.quick && asked.only.value_or(bench::ContactStudy::apart) == bench::ContactStudy::apart;
  if (reads_meshes) bench::expect_scenes(options.scenes);
  return measure_and_write(options, asked, bench::bench_contact);
}

int measure_collision(const BenchOptions& options) {
  const bench::CollisionOptions asked{.devices = selection_of(options), .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_collision);
}

int measure_dense(const BenchOptions& options) {
  if (!options.quick) bench::expect_scenes(options.scenes);
  const bench::DenseOptions asked{.devices = selection_of(options), .scenes = options.scenes, .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_dense);
}

int measure_drops(const BenchOptions& options) {
  if (!options.quick) bench::expect_scenes(options.scenes);
  const bench::DropsOptions asked{.devices = selection_of(options), .scenes = options.scenes, .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_drops);
}

int measure_draw(const BenchOptions& options) {
  bench::expect_scenes(options.scenes);
  const bench::DrawOptions asked{.gpu_index = options.gpu_index.value_or(0),
                                 .scenes = options.scenes,
                                 .size = {options.size[0], options.size[1]},
                                 .quick = options.quick};
  return measure_and_write(options, asked, bench::bench_draw);
}

}  // namespace

int bench(const BenchOptions& options) {
  switch (options.suite) {
    case BenchSuite::forces:
      return measure_forces(options);
    case BenchSuite::steps:
      return measure_steps(options);
    case BenchSuite::precision:
      return measure_precision(options);
    case BenchSuite::stability:
      return measure_stability(options);
    case BenchSuite::contact:
      return measure_contact(options);
    case BenchSuite::collision:
      return measure_collision(options);
    case BenchSuite::dense:
      return measure_dense(options);
    case BenchSuite::drops:
      return measure_drops(options);
    case BenchSuite::draw:
      break;
  }
  return measure_draw(options);
}

#else

int bench(const BenchOptions&) {
  throw Error(ErrorKind::device, "", "this pliant was built without benchmarks",
              "build it with them by `tools/build bench`, or with -DPLIANT_BUILD_BENCH=ON");
}

#endif

}  // namespace pliant::app
