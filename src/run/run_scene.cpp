// Steps from frame to frame. It measures, writes and draws at each frame, and reports at the end.
#include "run/run_scene.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "core/counted.hpp"
#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "dynamics/forces/force.hpp"
#include "output/csv.hpp"
#include "output/file.hpp"
#include "output/file_lock.hpp"
#include "run/batch.hpp"
#include "run/check.hpp"
#include "run/checkpoint.hpp"
#include "run/frame_sink.hpp"
#include "run/interrupts.hpp"
#include "run/prepared_run.hpp"
#include "run/report.hpp"
#include "run/together.hpp"
#include "simulation/measure.hpp"

namespace pliant {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double patience = 1;  // how long measuring may go on after Ctrl-C [s]

class Run {
 public:
  /// Begins at the start, or goes on from a checkpoint and takes over its lock.
  Run(const RunOptions& options, PreparedRun& prepared, std::optional<Resumed> from, Ranks* ranks)
      : options_(options),
        run_(prepared),
        leader_(*prepared.simulation, ranks),
        folder_(folder_of(options)),
        measuring_pool_(options.device.threads),
        meter_(prepared.start.model),
        progress_(from ? from->checkpoint.progress : RunProgress()),
        checkpoints_(options, from ? std::move(from->lock) : nullptr),
        folder_lock_(folder_),
        video_lock_(options.video.empty() ? nullptr : std::make_unique<FileLock>(options.video)),
        frames_(prepared, {.format = options.frames,
                           .folder = folder_ / "frames",
                           .video = options.video,
                           .first = static_cast<int>(progress_.frames_written)}),
        history_(from ? HistoryFile(folder_ / history_name, std::move(from->checkpoint.history))
                      : HistoryFile(folder_ / history_name)),
        before_row_{progress_, history_.text().size(), prepared.warnings.size()} {
    progress_.times.loading.add(prepared.load_time);
    progress_.times.building.add(prepared.build_time);
  }

  int execute() try {
    if (options_.timings) run_.simulation->time_passes();
    report_ = run_.simulation->report();
    if (checkpoints_.is_wanted()) keep_checkpoint(now());  // replaces another run's at once
    if (!options_.resume.empty() && !options_.quiet) show_beginning(status());
    if (report_.time == 0)
      begin();
    else
      state_ = run_.simulation->state();
    if (run_.plan.tolerance)
      run_adaptive();
    else
      run_fixed();
    keep_interrupted();
    history_.close();
    write_end();
    const int code = end_frames(has_failed() ? exit_failed : is_interrupted() ? exit_interrupted : 0);
    leader_.end();
    return code;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::command_line) throw;
    throw Error(error.kind(), "", error.what(), told_earlier_files());
  }

 private:
  // What a checkpoint holds of a run beside its simulation.
  struct Place {
    RunProgress progress;
    std::size_t history_length, warning_count;
  };
  Place now() const { return {progress_, history_.text().size(), run_.warnings.size()}; }

  RunStatus status() { return {options_, run_, progress_, report_}; }
  bool has_failed() const { return report_.breakdown || has_blown_up_; }
  bool stopped() const { return is_interrupted() || has_failed(); }

  void begin() {
    record();
    write_frame();
  }

  void run_fixed() {
    std::uint64_t step = progress_.recorded_steps;
    while (!stopped() && (step = run_.plan.next_frame_step(step)) <= run_.plan.steps) {
      advance_to(step);
      if (report_.steps == step) write_frame();
    }
    while (!stopped() && report_.steps < run_.plan.steps) advance_to(run_.plan.steps);
  }

  void run_adaptive() {
    std::optional<double> time;
    for (std::uint64_t& frame = progress_.next_frame; !stopped() && (time = run_.plan.time_of_frame(frame)); ++frame) {
      advance_to_time(*time);
      if (report_.time == *time) write_frame();
    }
    advance_to_time(run_.plan.duration);
  }

  void advance_to(std::uint64_t target) {
    while (report_.steps < target && !stopped()) advance_by(std::min(batch_.steps(), target - report_.steps));
    record_unless_recorded();
  }

  // Ends early where steps begin to take longer.
  void advance_by(std::uint64_t steps) {
    const double before = progress_.times.stepping.seconds();
    step([&] {
      const auto end = Clock::now() + std::chrono::duration<double>(Batch::time);
      leader_.advance(steps, [end] { return is_interrupted() || Clock::now() > end; });
      return run_.simulation->report();
    });
    batch_.took(progress_.times.stepping.seconds() - before);
  }

  void advance_to_time(double target) {
    while (report_.time < target && !stopped()) step([&] { return leader_.advance_toward(target); });
    record_unless_recorded();
  }

  template <class Advance>
  void step(const Advance& advance) {
    report_ = progress_.times.stepping.time(advance);
    if (!options_.quiet) show_progress(status());
    if (checkpoints_.is_due() && report_.time > 0) keep_checkpoint(now());
  }

  // If the run has failed, the checkpoint before is worth more. A run begins anew from time 0.
  bool keep_checkpoint(const Place& at) {
    if (has_failed()) return false;
    return progress_.times.saving.time([&] {
      Checkpoint checkpoint = checkpoint_of(options_, run_, at.progress, history_.text().substr(0, at.history_length));
      checkpoint.progress.times = progress_.times;
      checkpoint.warnings.resize(at.warning_count);
      return checkpoints_.write(checkpoint);
    });
  }

  // An interrupt may have put the latest row between two frames, even between two parts of a step, or left it without its energy.
  // So the checkpoint is from before that row, and a resumed run makes the row again.
  void keep_interrupted() {
    if (checkpoints_.is_wanted() && is_interrupted()) leaves_checkpoint_ = keep_checkpoint(before_row_);
  }

  void record_unless_recorded() {
    if (report_.steps != progress_.recorded_steps || report_.time != progress_.recorded_time) record();
  }

  void record() {
    before_row_ = now();
    run_.simulation->read_state(state_);
    leader_.compare(state_);
    Measurement& latest = progress_.latest;
    latest = progress_.times.measuring.time([&] { return measured(); });
    if (report_.time == 0) progress_.first = latest;
    note_energy();
    progress_.recorded_steps = report_.steps;
    progress_.recorded_time = report_.time;
    has_blown_up_ = has_blown_up(status());
    warn_of_forces();
    history_.append({.step = report_.steps,
                     .time = report_.time,
                     .kinetic = latest.kinetic,
                     .elastic = latest.elastic,
                     .gravitational = latest.gravitational,
                     .momentum = latest.momentum,
                     .angular_momentum = latest.angular_momentum,
                     .contact_steps = report_.contact_steps,
                     .reverted_vertices = report_.reverted_vertices,
                     .outside_impulse = report_.response.outside_impulse,
                     .contact_given = report_.response.energy_given,
                     .contact_taken = report_.response.energy_taken,
                     .friction_work = report_.response.friction_work,
                     .work_of_scripts = report_.response.work_of_scripts});
  }

  // An energy that was not measured to its end is NaN.
  void note_energy() {
    const Measurement &first = progress_.first, &now = progress_.latest;
    progress_.most_in_motion = std::max(progress_.most_in_motion, now.kinetic + now.elastic_size);
    progress_.most_of_gravity = std::max(progress_.most_of_gravity, std::abs(now.gravitational - first.gravitational));
    progress_.work_of_scripts = report_.response.work_of_scripts;
    progress_.most_work_of_scripts = std::max(progress_.most_work_of_scripts, std::abs(progress_.work_of_scripts));
    const double drift = std::abs(now.energy() - first.energy());
    progress_.largest_drift = drift <= progress_.largest_drift ? progress_.largest_drift : drift;
    const double gained = energy_gained(progress_);
    if (!(gained > progress_.most_gained)) return;
    progress_.most_gained = gained;
    progress_.time_of_gain = report_.time;
  }

  void warn_of_forces() {
    for (const Force& force : forces())
      if (force.warnings != nullptr)
        for (const std::string& warning : force.warnings(run_.start.model, state_)) warn_once(warning);
  }

  // A resumed run holds the warnings from before, so it does not repeat them.
  void warn_once(const std::string& warning) {
    if (std::ranges::find(run_.warnings, warning) != run_.warnings.end()) return;
    run_.warnings.push_back(warning);
    fmt::print(stderr, "pliant: warning: {}\n", warning);
  }

  // After Ctrl-C it measures for a moment only. If that is too short, the elastic energy is missing.
  Measurement measured() {
    const auto end = Clock::now() + std::chrono::duration<double>(patience);
    return meter_.measure(state_, run_.scene.simulation.gravity, measuring_pool_,
                          [end] { return is_interrupted() && Clock::now() > end; });
  }

  void write_frame() {
    progress_.times.writing.time([&] { frames_.write(state_); });
    progress_.frames_written = static_cast<std::uint64_t>(frames_.count());
  }

  // Runs last, so that all else is written if a video can't be ended. If the run itself failed, its exit code matters more than
  // the video's error.
  int end_frames(int exit_code) {
    try {
      frames_.close();
      show_frames();
    } catch (const Error& error) {
      if (exit_code == 0) throw;
      fmt::print(stderr, "pliant: {}\n", error.what());
    }
    return exit_code;
  }

  void show_frames() const {
    const auto written = static_cast<std::size_t>(frames_.count() - first_frame_);
    if (options_.quiet || written == 0) return;
    if (!options_.video.empty()) {
      fmt::print("video:   {} ({})\n", options_.video.string(), counted(written, "frame", "frames"));
      return;
    }
    const std::string left = earlier_frame();
    fmt::print("frames:  {} ({}{})\n", (folder_ / "frames").string(), counted(written, "file", "files"),
               left.empty() ? "" : fmt::format("; {} and later are of an earlier run", left));
  }

  // Returns the name of the next frame, if an earlier run has left it. It would end up in a video that someone makes of all
  // frames.
  std::string earlier_frame() const {
    const auto next = frame_path(folder_ / "frames", static_cast<int>(progress_.frames_written), options_.frames);
    std::error_code unknown;  // counts as none
    return std::filesystem::exists(next, unknown) ? next.filename().string() : "";
  }

  // If a file can't be written, files of an earlier run may stand beside those of this run. Returns which.
  std::string told_earlier_files() const {
    std::string names;
    const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
    std::error_code unknown;  // counts as none
    if (!has_state_ && std::filesystem::exists(folder_ / final_state_name, unknown)) add(final_state_name);
    if (!has_summary_ && std::filesystem::exists(folder_ / summary_name, unknown)) add(summary_name);
    if (options_.frames != FrameFormat::none && !earlier_frame().empty()) add(earlier_frame() + " and later frames");
    return names.empty() ? "" : fmt::format("left there by an earlier run: {}; all else is of this one", names);
  }

  // If the state can't be written, the summary may still fit, because it is small.
  void write_end() {
    const std::optional<Error> lost = write_state();
    has_state_ = !lost;
    write_summary(folder_ / summary_name, summary_of(status()));
    has_summary_ = true;
    if (!options_.quiet) show_end(status());
    if (!options_.quiet && leaves_checkpoint_)
      fmt::print("checkpoint: {0} (go on with: pliant run --resume '{0}')\n", options_.checkpoint.string());
    for (const std::string& trouble : contact_troubles_of(status())) fmt::print(stderr, "pliant: warning: {}\n", trouble);
    for (const std::string& trouble : cluster_troubles_of(status())) fmt::print(stderr, "pliant: warning: {}\n", trouble);
    if (const auto what = instability_of(status())) fmt::print(stderr, "pliant: {}{}\n", has_failed() ? "" : "warning: ", *what);
    if (lost) throw *lost;
  }

  std::optional<Error> write_state() const try {
    const Model& model = run_.start.model;
    write_final_state(folder_ / final_state_name, model, state_.world_positions(model), state_.world_velocities(model));
    return {};
  } catch (const Error& error) {
    return error;
  }

  const RunOptions& options_;
  PreparedRun& run_;
  Leader leader_;
  std::filesystem::path folder_;
  ThreadPool measuring_pool_;
  Meter meter_;
  RunProgress progress_;
  CheckpointKeeper checkpoints_;
  FileLock folder_lock_;  // one run at a time writes into the folder
  std::unique_ptr<FileLock> video_lock_;
  FrameSink frames_;  // made before any file is touched, because drawing may be impossible here
  HistoryFile history_;
  Place before_row_;  // the latest one
  StepReport report_;
  int first_frame_ = frames_.count();
  Batch batch_;  // between reports
  State state_;
  bool has_blown_up_ = false;
  bool has_state_ = false, has_summary_ = false;  // this run has written them
  bool leaves_checkpoint_ = false;                // of where it was interrupted
};

// Throws Error if the folder can't be made or written to. It tries by making and removing the first missing folder, because
// permissions do not tell everywhere, for example in /proc.
void expect_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::path existing = std::filesystem::absolute(folder, failure), missing;
  while (!std::filesystem::exists(existing, failure) && existing.has_relative_path())
    existing = (missing = existing).parent_path();
  if (!std::filesystem::is_directory(existing, failure))
    throw Error(ErrorKind::command_line, existing.string(), "is no folder", "name another place by --out");
  if (missing.empty() && access(existing.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorKind::command_line, existing.string(), "can't be written", "name another place by --out");
  if (missing.empty()) return;
  std::filesystem::create_directory(missing, failure);
  if (failure) throw Error(ErrorKind::command_line, missing.string(), "this folder can't be made", "name another place by --out");
  std::filesystem::remove(missing, failure);
}

// Checks the outputs before any is replaced, and before hours of steps.
void expect_outputs(const RunOptions& options) {
  const std::filesystem::path folder = folder_of(options);
  expect_folder(folder);
  for (const char* name : output_names) {
    std::error_code failure;
    if (std::filesystem::is_fifo(folder / name, failure))
      throw Error(ErrorKind::command_line, (folder / name).string(), "is a pipe, and a run writes files",
                  "name another place by --out");
    expect_replaceable(folder / name);
  }
  if (options.frames != FrameFormat::none) expect_folder(folder / "frames");
}

// Its file is read, and locked, on rank 0 alone.
void take_checkpoint_of_first(Ranks& ranks, std::optional<Resumed>& from) {
  const std::string bytes = text_of_first(ranks, from ? to_bytes(from->checkpoint) : "");
  if (!from) from = Resumed{checkpoint_from(bytes), nullptr};
}

// A resumed run may have such a warning already.
void warn_of_ranks(PreparedRun& run, const RunOptions& options, const Ranks& ranks) {
  for (const std::string& told : told_of_ranks(options.device, ranks, run.start.model))
    if (std::ranges::find(run.warnings, told) == run.warnings.end()) run.warnings.push_back(told);
}

// If no program can encode a video, its frames are written as pictures.
RunOptions drawable(RunOptions options) {
  if (options.video.empty() || VideoFile::has_encoder()) return options;
  options.video.clear();
  options.frames = FrameFormat::png;
  return options;
}

}  // namespace

std::filesystem::path scene_of(const RunOptions& options) { return options.base / options.scene; }

std::filesystem::path folder_of(const RunOptions& options) {
  return options.base / (options.out.empty() ? std::filesystem::path("out") / options.scene.stem() : options.out);
}

int run_scene(const RunOptions& given, Ranks* ranks) {
  const bool leads = ranks == nullptr || ranks->number() == 0;
  if (ranks != nullptr) expect_same_options(*ranks, given);
  if (given.check) {  // it is about one machine
    if (!leads) return 0;
    ranks = nullptr;
  }
  std::optional<Resumed> from;
  do_together(ranks, [&] {
    if (leads && !given.resume.empty()) from = load_resumed(given);
  });
  if (ranks != nullptr && !given.resume.empty()) take_checkpoint_of_first(*ranks, from);
  RunOptions options;
  std::unique_ptr<PreparedRun> run;
  do_together(ranks, [&] {
    options = from ? resumed_options(given, from->checkpoint) : drawable(given);
    if (!leads) options.quiet = true;
    if (leads && (!options.check || !options.out.empty())) expect_outputs(options);
    run = prepare_run(options, ranks);
    if (from) resume(given, from->checkpoint, *run);
    if (ranks != nullptr) warn_of_ranks(*run, options, *ranks);
    if (options.skipping != Skipping{}) run->simulation->skip(options.skipping);
  });
  if (ranks != nullptr) expect_same_runs(*ranks, *run);
  if (!given.video.empty() && options.video.empty())
    run->warnings.emplace_back("--video: there is no ffmpeg on PATH: frames are written as PNG files instead; install ffmpeg");
  if (leads)
    for (const std::string& warning : run->warnings) fmt::print(stderr, "pliant: warning: {}\n", warning);
  if (options.check) {
    show_check(*run);
    return 0;
  }
  std::optional<Run> lead;
  do_together(ranks, [&] {
    if (leads) lead.emplace(options, *run, std::move(from), ranks);
  });
  if (leads) {
    watch_for_interrupts("the steps in hand, or a part of one");
    return lead->execute();
  }
  follow(*run->simulation, *ranks);
  return 0;
}

}  // namespace pliant
