#include "run/checkpoint.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>
#include <utility>

#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "output/checkpoint_file.hpp"
#include "output/file.hpp"
#include "simulation/start_check.hpp"

namespace pliant {
namespace {

// A checkpoint holds these structs as bytes of memory. If you change one, raise checkpoint_version too: the sizes here do not
// show a changed order. It also holds a scene's text. If a default of scenes changes, raise it, too: a run must end as it began.
static_assert(checkpoint_version == 41 && sizeof(physics::Cluster) == 304 && sizeof(physics::Pose) == 200 &&
                  sizeof(physics::Status) == 56 && sizeof(physics::Tally) == 20 && sizeof(physics::Control) == 184 &&
                  sizeof(physics::Pace) == 192 && sizeof(physics::StepParts) == 40 && sizeof(physics::Debt) == 40 &&
                  sizeof(RunProgress) == 344 && sizeof(physics::PathState) == 248,
              "what a checkpoint holds has changed: raise checkpoint_version, and put the sizes right here");

// Names every option, so that adding one does not compile until this function says whether a checkpoint holds it.
template <class Archive, class Options>
void visit_options(Archive& archive, Options& options) {
  auto& [base, scene, device, steps, duration, time_step, tolerance, integrator, overrides, out, frames, video, checkpoint,
         interval, resume, scene_text, meshes, timings, skipping, check, quiet] = options;
  auto& [kind, gpu_index, precision, threads] = device;
  archive(scene, kind, gpu_index, precision, threads, steps, duration, time_step, tolerance, integrator, overrides, out, frames,
          interval);
  for (const SkippingKind& row : skipping_kinds) archive(skipping.*row.is_skipped);
}

// Serves writing and reading.
template <class Archive, class Held>
void visit(Archive& archive, Held& held) {
  auto& [version, options, working_folder, device_name, scene_text, mesh_checksums, warnings, progress, history, simulation] =
      held;
  archive(version);
  visit_options(archive, options);
  archive(working_folder, device_name, scene_text, mesh_checksums, warnings, progress, history, simulation);
}

// If the folder is gone, the project was moved. Relative paths then start in the current folder.
bool is_here_or_gone(const std::filesystem::path& folder) {
  std::error_code failure;
  return folder == std::filesystem::current_path(failure) || !std::filesystem::is_directory(folder, failure);
}

bool names_device(const RunOptions& given) { return given.device.wish || given.device.gpu_index || given.device.precision; }

void expect_meshes(const Checkpoint& checkpoint, const PreparedRun& run) {
  const std::vector<std::uint64_t>&before = checkpoint.mesh_checksums, &now = run.mesh_checksums;
  if (before.size() != now.size())
    throw Error(ErrorKind::input, "", "its scene has other bodies than when the run began", "use the pliant that wrote it");
  for (std::size_t body = 0; body < now.size(); ++body)
    if (before[body] != now[body])
      throw Error(ErrorKind::input, "", fmt::format("the mesh of body \"{}\" has changed since", run.scene.bodies[body].name),
                  "bring back the mesh that the run was begun with");
}

int precision_of(const Checkpoint& before) { return before.options.device.precision.value_or(32); }

std::string device_of(const std::string& device, int precision) { return fmt::format("{} at precision {}", device, precision); }
std::string device_of(const Checkpoint& before) { return device_of(before.device_name, precision_of(before)); }
std::string device_of(const PreparedRun& now) { return device_of(now.device->info().name, now.device->precision()); }

void expect_device(const RunOptions& given, const Checkpoint& before, const PreparedRun& now) {
  if (device_of(before) == device_of(now) || names_device(given)) return;
  throw Error(ErrorKind::device, "",
              fmt::format("the run was on {}, and this is {}: its bits would differ", device_of(before), device_of(now)),
              "use the same device as before, or ask for this one with --device or --precision");
}

bool is_over(const PreparedRun& run) {
  const StepReport report = run.simulation->report();
  return run.plan.tolerance ? report.time >= run.plan.duration : report.steps >= run.plan.steps;
}

// Keeps the warnings that the run had, and warns if its bits may differ from here on.
void add_warnings(const Checkpoint& before, PreparedRun& run) {
  run.warnings = before.warnings;
  if (is_over(run)) return;  // no more steps are made, so no bits can differ
  const std::uint64_t step = run.simulation->report().steps;
  if (device_of(before) != device_of(run))
    run.warnings.push_back(
        fmt::format("up to step {} the run was on {}, and from there on it is on {}: its bits differ from there on", step,
                    device_of(before), device_of(run)));
  if (before.version != full_version())
    run.warnings.push_back(
        fmt::format("up to step {} the run was by pliant {}, and from there on it is by {}: its bits may differ from there on",
                    step, before.version, full_version()));
}

Checkpoint load_checkpoint(const std::filesystem::path& file) {
  const std::string content = read_checkpoint(file);
  try {
    return checkpoint_from(content);
  } catch (const Error& error) {
    throw Error(error.kind(), file.string(), error.what(), "take an earlier copy");
  }
}

// Works for files that do not exist yet, too.
std::filesystem::path full_place(const std::filesystem::path& path) {
  std::error_code failure;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(place_behind(path), failure), failure);
}

// Also finds that two names are hard links to one file.
bool is_same_place(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code failure;
  return full_place(a) == full_place(b) || std::filesystem::equivalent(a, b, failure);
}

void expect_no_output(const std::filesystem::path& file, const RunOptions& options) {
  const auto expect_other = [&](bool is_other, const char* written) {
    if (!is_other)
      throw Error(ErrorKind::command_line, "--checkpoint " + file.string(), fmt::format("is where the run writes {}", written),
                  "name another place");
  };
  const std::filesystem::path folder = folder_of(options);
  for (const char* name : output_names) expect_other(!is_same_place(file, folder / name), name);
  expect_other(!is_same_place(file, FileLock::place_of(folder)), "its lock");
  expect_other(options.frames == FrameFormat::none || full_place(file).parent_path() != full_place(folder / "frames"),
               "its frames");
}

void take_out(RunOptions& run, const RunOptions& given) {
  if (!given.out.empty()) run.out = run.base.empty() ? given.out : std::filesystem::absolute(given.out);
}

void take_device(RunOptions& run, const RunOptions& given) {
  if (!given.device.wish && !given.device.gpu_index) return;
  run.device.wish = given.device.wish;
  run.device.gpu_index = given.device.gpu_index;
  if (given.device.wish == DeviceWish::gpu || given.device.gpu_index) run.device.precision.reset();  // a GPU has only one
}

void take_threads(RunOptions& run, const RunOptions& given) {
  if (given.device.threads != 0) run.device.threads = given.device.threads;
}

template <class T>
void take(std::optional<T>& had, const std::optional<T>& given) {
  if (given) had = given;
}

constexpr OptionBesideResume beside_resume[] = {
    {"--out", take_out},
    {"--checkpoint", [](auto& run, auto& given) { run.checkpoint = given.checkpoint.empty() ? given.resume : given.checkpoint; }},
    {"--checkpoint-every", [](auto& run, auto& given) { take(run.checkpoint_interval, given.checkpoint_interval); }},
    {"--device", take_device},
    {"--gpu", take_device},
    {"--precision", [](auto& run, auto& given) { take(run.device.precision, given.device.precision); }},
    {"--threads", take_threads},
    {"--quiet", [](auto& run, auto& given) { run.quiet = given.quiet; }}};

}  // namespace

Checkpoint checkpoint_of(const RunOptions& options, PreparedRun& run, const RunProgress& progress, const std::string& history) {
  Checkpoint checkpoint{.version = full_version(),
                        .options = options,
                        .working_folder = run.working_folder,
                        .device_name = run.device->info().name,
                        .scene_text = run.scene_text,
                        .mesh_checksums = run.mesh_checksums,
                        .warnings = run.warnings,
                        .progress = progress,
                        .history = history,
                        .simulation = run.simulation->save()};
  checkpoint.options.device.wish = run.device->info().kind == DeviceKind::gpu ? DeviceWish::gpu : DeviceWish::cpu;
  checkpoint.options.device.precision = run.device->precision();
  return checkpoint;
}

std::string to_bytes(const Checkpoint& checkpoint) {
  ByteWriter to;
  visit(to, checkpoint);
  return to.take();
}

Checkpoint checkpoint_from(std::string_view bytes) {
  ByteReader from(bytes);
  Checkpoint checkpoint;
  visit(from, checkpoint);
  if (!from.at_end()) throw Error(ErrorKind::input, "", "holds more than a checkpoint does", "");
  return checkpoint;
}

// Locks the file before it reads it. Else another run could write there after the reading, and that would be lost.
Resumed load_resumed(const RunOptions& given) {
  const bool goes_on_there = given.checkpoint.empty() || full_place(given.checkpoint) == full_place(given.resume);
  std::unique_ptr<FileLock> lock;
  if (std::error_code failure; std::filesystem::exists(given.resume, failure))
    lock = std::make_unique<FileLock>(given.resume, goes_on_there ? FileLock::For::writing : FileLock::For::reading);
  Checkpoint checkpoint = load_checkpoint(given.resume);
  return {std::move(checkpoint), goes_on_there ? std::move(lock) : nullptr};
}

std::span<const OptionBesideResume> options_beside_resume() { return beside_resume; }

RunOptions resumed_options(const RunOptions& given, const Checkpoint& checkpoint) {
  RunOptions run = checkpoint.options;
  run.scene_text = checkpoint.scene_text;
  run.resume = given.resume;
  if (!is_here_or_gone(checkpoint.working_folder)) run.base = checkpoint.working_folder;
  for (const OptionBesideResume& option : beside_resume) option.take(run, given);
  return run;
}

void resume(const RunOptions& given, const Checkpoint& checkpoint, PreparedRun& run) {
  try {
    expect_meshes(checkpoint, run);
    expect_device(given, checkpoint, run);
    run.simulation->restore(checkpoint.simulation);
    add_warnings(checkpoint, run);
  } catch (const Error& error) {
    throw error.within(error.kind(), given.resume.string());
  }
  if (!is_over(run) && run.device->precision() < precision_of(checkpoint))
    expect_provable(*run.simulation, run.start.model, run.scene.collision, given.resume.string());
}

CheckpointKeeper::CheckpointKeeper(const RunOptions& options, std::unique_ptr<FileLock> lock)
    : file_(options.checkpoint),
      lock_(std::move(lock)),
      has_one_(lock_ != nullptr),  // with a lock the run goes on from a checkpoint in this file
      interval_(options.checkpoint_interval.value_or(default_checkpoint_interval)) {
  if (!is_wanted()) return;
  expect_no_output(file_, options);
  if (!lock_) lock_ = std::make_unique<FileLock>(file_);
  expect_place_for_checkpoint(file_);
}

bool CheckpointKeeper::write(const Checkpoint& checkpoint) {
  try {
    write_checkpoint(file_, to_bytes(checkpoint));
    has_one_ = true;
    problem_.clear();
  } catch (const Error& error) {
    if (problem_ != error.what())
      fmt::print(stderr, "pliant: warning: no checkpoint is written: {}; the run goes on, and {}\n", error.what(),
                 has_one_ ? "the checkpoint before it stays" : "has no checkpoint yet");
    problem_ = error.what();
  }
  latest_ = Clock::now();
  return problem_.empty();
}

}  // namespace pliant
