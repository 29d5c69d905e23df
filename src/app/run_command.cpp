// Steps from frame to frame; measures, writes and draws at each; reports at the end.
#include "app/run_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/checkpoint.hpp"
#include "app/frame_sink.hpp"
#include "app/interrupts.hpp"
#include "app/prepared_run.hpp"
#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "output/csv.hpp"
#include "output/file.hpp"
#include "output/summary.hpp"
#include "simulation/measure.hpp"

namespace pliant::app {
namespace {

constexpr double patience = 1;           // that Ctrl-C has with measuring [s]
constexpr double time_of_a_batch = 0.1;  // of steps, after which Ctrl-C is heard and progress shown [s]

class Run {
 public:
  /// From its start, or from where the checkpoint stood.
  Run(const RunOptions& options, PreparedRun& prepared, const Checkpoint* from)
      : options_(options),
        run_(prepared),
        folder_(folder_of(options)),
        measuring_pool_(options.device.threads),
        is_resumed_(from != nullptr),
        progress_(from == nullptr ? RunProgress() : from->progress),
        frames_(prepared, {.format = options.frames,
                           .folder = folder_ / "frames",
                           .video = options.video,
                           .first = static_cast<int>(progress_.frames_written)}),
        checkpoints_(options),
        history_(from == nullptr ? HistoryFile(folder_ / "history.csv") : HistoryFile(folder_ / "history.csv", from->history)),
        before_row_{progress_, history_.text().size()} {
    stepping_.add(progress_.stepping_seconds);
    measuring_.add(progress_.measuring_seconds);
    writing_.add(progress_.writing_seconds);
    saving_.add(progress_.saving_seconds);
    for (const char* name : {"final_state.csv", "summary.json"}) expect_replaceable(folder_ / name);  // not after hours of steps
  }

  int execute() {
    if (options_.timings) run_.simulation->time_passes();
    report_ = run_.simulation->report();
    if (is_resumed_)
      state_ = run_.simulation->state();
    else
      begin();
    if (run_.plan.tolerance)
      run_adaptive();
    else
      run_fixed();
    keep_interrupted();
    history_.close();
    write_end();
    end_frames();
    if (report_.non_finite) return exit_non_finite;
    return is_interrupted() ? exit_interrupted : 0;
  }

 private:
  bool stopped() const { return is_interrupted() || report_.non_finite; }

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
    advance_to(run_.plan.steps);
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
    while (report_.steps < target && !stopped()) advance_by(std::min(batch_, target - report_.steps));
    record_unless_recorded();
  }

  // Batches grow while they are short: a report a step would cost more than small steps do.
  void advance_by(std::uint64_t steps) {
    const double before = stepping_.seconds();
    step([&] {
      run_.simulation->advance(steps);
      return run_.simulation->report();
    });
    const bool is_short = stepping_.seconds() - before < time_of_a_batch;
    batch_ = is_short ? std::min(2 * batch_, Simulation::most_steps_at_once) : std::max<std::uint64_t>(batch_ / 2, 1);
  }

  void advance_to_time(double target) {
    while (report_.time < target && !stopped()) step([&] { return run_.simulation->advance_toward(target); });
    record_unless_recorded();
  }

  template <class Advance>
  void step(const Advance& advance) {
    report_ = stepping_.time(advance);
    show_progress();
    if (checkpoints_.is_due()) keep_checkpoint(progress_, history_.text());
  }

  // Not of a run that has failed: the one before is worth more.
  void keep_checkpoint(RunProgress progress, const std::string& history) {
    if (report_.non_finite) return;
    progress.stepping_seconds = stepping_.seconds();
    progress.measuring_seconds = measuring_.seconds();
    progress.writing_seconds = writing_.seconds();
    progress.saving_seconds = saving_.seconds();
    saving_.time([&] { checkpoints_.write(checkpoint_of(options_, run_, progress, history)); });
  }

  // An interrupt may have put the latest row between two frames, or left it without its energy: it is made again.
  void keep_interrupted() {
    if (checkpoints_.is_wanted() && is_interrupted() && report_.steps > 0)
      keep_checkpoint(before_row_.progress, history_.text().substr(0, before_row_.history_length));
  }

  void record_unless_recorded() {
    if (report_.steps != progress_.recorded_steps) record();
  }

  void record() {
    before_row_ = {progress_, history_.text().size()};
    state_ = run_.simulation->state();
    Measurement& now = progress_.latest;
    now = measuring_.time([&] { return measured(); });
    if (report_.steps == 0) progress_.first = now;
    progress_.most_in_motion = std::max(progress_.most_in_motion, now.kinetic + now.elastic);
    const double drift = std::abs(now.energy() - progress_.first.energy());
    progress_.largest_drift = drift <= progress_.largest_drift ? progress_.largest_drift : drift;
    progress_.recorded_steps = report_.steps;
    history_.append({.step = report_.steps,
                     .time = report_.time,
                     .kinetic = now.kinetic,
                     .elastic = now.elastic,
                     .gravitational = now.gravitational,
                     .momentum = now.momentum,
                     .angular_momentum = now.angular_momentum,
                     .contact_steps = report_.contact_steps,
                     .reverted_vertices = report_.reverted_vertices});
  }

  // After Ctrl-C for a moment only; without the elastic energy where that is not enough.
  Measurement measured() {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(patience);
    return measure(run_.start.model, state_, run_.scene.simulation.gravity, measuring_pool_,
                   [end] { return is_interrupted() && Clock::now() > end; });
  }

  void write_frame() {
    writing_.time([&] { frames_.write(state_); });
    progress_.frames_written = static_cast<std::uint64_t>(frames_.count());
  }

  // At last: when a video can't be ended, all else is there.
  void end_frames() {
    frames_.close();
    if (options_.quiet || frames_.count() == 0) return;
    if (options_.video.empty())
      fmt::print("frames:  {} ({} files)\n", (folder_ / "frames").string(), frames_.count());
    else
      fmt::print("video:   {} ({} frames)\n", options_.video.string(), frames_.count());
  }

  // Less than this is rounding, or nothing to speak of: of a spring as long as a body's radius, some 1e-12.
  double smallest_energy() const {
    double scale = std::numeric_limits<double>::min();
    for (const ModelBody& body : run_.start.model.bodies)
      scale = std::max(scale, 1e-12 * 0.5 * body.stiffness * body.radius * body.radius);
    return scale;
  }

  // Against what there was at the start and what gravity has given since: neither depends on where the world's origin is.
  double energy_growth() const {
    const Measurement &first = progress_.first, &latest = progress_.latest;
    const double had = first.kinetic + first.elastic + std::abs(latest.gravitational - first.gravitational);
    return 1 + (latest.energy() - first.energy()) / std::max(had, smallest_energy());
  }

  void write_end() {
    const Model& model = run_.start.model;
    write_final_state(folder_ / "final_state.csv", model, state_.world_positions(model), state_.world_velocities(model));
    write_summary(folder_ / "summary.json", summary());
    if (!options_.quiet) show_end();
    if (const auto what = instability()) fmt::print(stderr, "pliant: {}{}\n", report_.non_finite ? "" : "warning: ", *what);
  }

  Summary summary() {
    Summary s;
    s.scene = run_.scene.file.string();
    s.device = {run_.device->info().kind, run_.device->info().name};
    s.precision = run_.device->precision();
    s.threads = run_.device->info().threads;
    s.integrator = run_.plan.integrator->name;
    if (const auto& adaptive = report_.adaptive)
      s.adaptive = {*run_.plan.tolerance,          report_.steps,           adaptive->rejected,
                    adaptive->rejected_in_contact, adaptive->smallest_step, adaptive->largest_step};
    else
      s.time_step = run_.plan.time_step;
    s.steps = report_.steps;
    s.simulated_seconds = report_.time;
    s.wall_seconds = stepping_.seconds();
    s.steps_per_second = report_.steps == 0 ? 0 : static_cast<double>(report_.steps) / stepping_.seconds();
    s.energy = {progress_.first.energy(), progress_.latest.energy(), {}};
    if (run_.plan.damping_law == DampingLaw::none && report_.contact_steps == 0)
      s.energy.max_drift = progress_.largest_drift / std::max(progress_.most_in_motion, smallest_energy());
    s.contacts = {report_.contact_steps, report_.contact_pairs_max, report_.reverted_vertices};
    if (report_.non_finite)
      s.energy.final = std::nan("");  // the step that broke, whatever a sum of it gives
    else
      s.final_intersecting_pairs = run_.simulation->intersections().pairs;
    s.non_finite = report_.non_finite.has_value();
    s.interrupted = is_interrupted();
    s.work = {report_.force_evaluations, report_.pair_interactions, report_.nodes_refitted, report_.node_tests,
              report_.triangle_tests};
    s.skipped = {{"force_evaluations", report_.forces_skipped},
                 {"body_pairs", report_.body_pairs_skipped},
                 {"tree_refits", report_.refits_skipped}};
    s.timings_ms = {{"load", 1e3 * run_.load_time.seconds()},
                    {"build", 1e3 * run_.build_time.seconds()},
                    {"step", 1e3 * stepping_.seconds()},
                    {"measure", 1e3 * measuring_.seconds()},
                    {"frames", 1e3 * writing_.seconds()}};
    if (checkpoints_.is_wanted()) s.timings_ms.emplace_back("checkpoints", 1e3 * saving_.seconds());
    for (const auto& [pass, seconds] : run_.simulation->pass_seconds())
      s.pass_timings_ms.emplace_back(std::string(pass), 1e3 * seconds);
    s.warnings = run_.warnings;
    if (const auto what = instability()) s.warnings.push_back(*what);
    s.version = PLIANT_VERSION;
    return s;
  }

  void show_progress() const {
    if (options_.quiet || isatty(fileno(stderr)) == 0) return;
    const bool adapts = report_.adaptive.has_value();
    const double done =
        adapts ? report_.time / run_.plan.duration : static_cast<double>(report_.steps) / static_cast<double>(run_.plan.steps);
    fmt::print(stderr, "\r[{:<30}] {:3.0f} %  step {}{}  {:.1f} steps/s ", std::string(static_cast<std::size_t>(30 * done), '#'),
               100 * done, report_.steps, adapts ? "" : fmt::format("/{}", run_.plan.steps),
               static_cast<double>(report_.steps) / stepping_.seconds());
    if (stopped() || done == 1) fmt::print(stderr, "\n");
  }

  std::string length_of_steps() const {
    if (!report_.adaptive) return fmt::format("{:.6g} s", run_.plan.time_step);
    return fmt::format("{:.3g} to {:.3g} s ({} rejected, {} of them in contact)", report_.adaptive->smallest_step,
                       report_.adaptive->largest_step, report_.adaptive->rejected, report_.adaptive->rejected_in_contact);
  }

  void show_end() const {
    fmt::print("{}{} steps of {} by {} in {:.2f} s ({:.1f} steps/s) on {} ({})\n", is_interrupted() ? "interrupted after " : "",
               report_.steps, length_of_steps(), run_.plan.integrator->name, stepping_.seconds(),
               report_.steps == 0 ? 0.0 : static_cast<double>(report_.steps) / stepping_.seconds(), run_.device->info().kind,
               run_.device->info().name);
    const double beside = measuring_.seconds() + writing_.seconds() + saving_.seconds();
    if (beside > 0.1 && 9 * beside > stepping_.seconds())  // over a tenth of the whole
      fmt::print("beside these, {:.2f} s of measuring the state and {:.2f} s of frames{}\n", measuring_.seconds(),
                 writing_.seconds(),
                 checkpoints_.is_wanted() ? fmt::format(" and {:.2f} s of checkpoints", saving_.seconds()) : "");
    fmt::print("contacts in {} steps, at most {} triangle pairs at once\n", report_.contact_steps, report_.contact_pairs_max);
    show_timings();
    fmt::print("summary: {}\n", (folder_ / "summary.json").string());
  }

  void show_timings() const {
    if (!options_.timings || report_.steps == 0) return;
    double all = 0;
    for (const auto& [pass, seconds] : run_.simulation->pass_seconds()) all += seconds;
    fmt::print("{:<20} {:>12} {:>8}\n", "pass", "us a step", "share");
    for (const auto& [pass, seconds] : run_.simulation->pass_seconds())
      fmt::print("{:<20} {:>12.2f} {:>6.1f} %\n", pass, 1e6 * seconds / static_cast<double>(report_.steps), 100 * seconds / all);
    fmt::print("{:<20} {:>12.2f}\n", "together", 1e6 * all / static_cast<double>(report_.steps));
  }

  std::string remedy_for_breakdown() const {
    if (run_.plan.tolerance) return "loosen the tolerance, or lower stiffness, damping or velocities";
    if (run_.plan.time_step > run_.plan.step_bound)
      return fmt::format("shorten the time step to {:.4g} s or less", run_.plan.step_bound);
    return "shorten the time step, or lower stiffness, damping or velocities";
  }

  std::string reason_for_breakdown(const NonFinite& where) const {
    if (where.failed_step == 0) return "the simulation became non-finite";
    return fmt::format("no step down to {:.3g} s meets the tolerance of {:g}", where.failed_step, *run_.plan.tolerance);
  }

  // What went wrong, for people and for the summary; the step beyond its bound is among the warnings from before the run.
  std::optional<std::string> instability() const {
    if (report_.non_finite) {
      const NonFinite& where = *report_.non_finite;
      return fmt::format("{} in step {} at vertex {} of body \"{}\"; {}", reason_for_breakdown(where), where.step, where.vertex,
                         run_.start.model.bodies[where.body].name, remedy_for_breakdown());
    }
    const double growth = energy_growth();
    if (growth > 2)
      return fmt::format(
          "the energy has grown {:.3g}-fold: {}", growth,
          report_.contact_steps > 0 ? "contacts have added it, or the motion is unstable" : "the motion is unstable");
    return {};
  }

  const RunOptions& options_;
  PreparedRun& run_;
  std::filesystem::path folder_;
  ThreadPool measuring_pool_;
  bool is_resumed_;
  RunProgress progress_;
  FrameSink frames_;  // before any file is touched: there may be nothing to draw with
  CheckpointKeeper checkpoints_;
  HistoryFile history_;
  struct {
    RunProgress progress;
    std::size_t history_length;
  } before_row_;  // the latest one
  StepReport report_;
  std::uint64_t batch_ = 1;  // steps between reports
  State state_;
  Stopwatch stepping_, measuring_, writing_, saving_;
};

// Times a step with every body deformed, so that no force is skipped; a second one, unless that would take long, because the
// first also pays for what is done once.
double seconds_per_step(PreparedRun& run) {
  State deformed = run.start.state;
  for (std::size_t i = 0; i < run.start.model.rest_positions.size(); ++i)
    for (int k = 0; k < 3; ++k)
      deformed.motion[6 * i + static_cast<std::size_t>(k)] += 1e-3 * run.start.model.rest_positions[i][k];
  Simulation trial(*run.device, run.start.model, deformed, run.plan, run.scene.collision);
  const auto seconds_of_step = [&] {
    Stopwatch watch;
    watch.time([&] {
      trial.advance(1);
      run.device->finish();
    });
    return watch.seconds();
  };
  const double first = seconds_of_step();
  return first < 1 ? seconds_of_step() : first;
}

struct Estimate {
  double steps = 0, seconds = 0;
};

Estimate estimate_fixed(PreparedRun& run) {
  const auto steps = static_cast<double>(run.plan.steps);
  return {steps, steps * seconds_per_step(run)};
}

// Runs the scene for a second, at least one batch of steps, and takes the rest to be alike; no number where nothing came of it.
// Bodies that meet only later, or come to rest, are beyond it.
Estimate estimate_adaptive(PreparedRun& run) {
  Simulation trial(*run.device, run.start.model, run.start.state, run.plan, run.scene.collision);
  StepReport report = trial.report();
  Stopwatch watch;
  for (std::uint64_t frame = 1; watch.seconds() < 1 && report.time < run.plan.duration && !report.non_finite;) {
    const double target = run.plan.time_of_frame(frame).value_or(run.plan.duration);
    if (report.time < target)
      report = watch.time([&] { return trial.advance_toward(target); });
    else
      ++frame;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (report.non_finite || (report.time == 0 && run.plan.duration > 0)) return {nothing, nothing};
  const double part = run.plan.duration > 0 ? report.time / run.plan.duration : 1;
  return {static_cast<double>(report.steps) / part, watch.seconds() / part};
}

std::string length_of_steps(const TimePlan& plan) {
  if (plan.tolerance) return fmt::format("by a tolerance of {:g}", *plan.tolerance);
  return fmt::format("{:.6g} s ({:.3g} of the bound)", plan.time_step, plan.time_step / plan.step_bound);
}

std::string count_of_steps(const TimePlan& plan, double count) {
  if (std::isnan(count)) return "unknown: no step of the trial stood, or it went non-finite";
  return fmt::format("{}{:.0f}", plan.tolerance ? "about " : "", count);
}

void show_check(PreparedRun& run) {
  const Estimate estimate = run.plan.tolerance ? estimate_adaptive(run) : estimate_fixed(run);
  const std::size_t bytes = run.device->allocated_bytes();  // with what a first step has made the device take
  fmt::print("scene:            {}\n", run.scene.title.empty() ? run.scene.file.string() : run.scene.title);
  for (const ModelBody& body : run.start.model.bodies)
    fmt::print("body:             {} ({} vertices, {} triangles)\n", body.name, body.vertex_count, body.triangle_count);
  fmt::print("integrator:       {}\n", run.plan.integrator->name);
  fmt::print("stability bound:  {:.6g} s\n", run.plan.step_bound);
  fmt::print("time step:        {}\n", length_of_steps(run.plan));
  fmt::print("steps:            {}\n", count_of_steps(run.plan, estimate.steps));
  fmt::print("device:           {} ({})\n", run.device->info().kind, run.device->info().name);
  fmt::print("device memory:    {:.1f} MB\n", static_cast<double>(bytes) / 1e6);
  fmt::print("stepping time:    {}\n",
             std::isnan(estimate.seconds) ? "unknown" : fmt::format("about {:.3g} s", estimate.seconds));
}

// Makes the first folder that is missing, and removes it: permissions do not tell it everywhere, as in /proc.
void expect_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::path existing = std::filesystem::absolute(folder, failure), missing;
  while (!std::filesystem::exists(existing, failure) && existing.has_relative_path())
    existing = (missing = existing).parent_path();
  if (!std::filesystem::is_directory(existing, failure))
    throw Error(ErrorKind::command_line, existing.string(), "is no folder", "name another place by --out");
  if (missing.empty()) return;
  std::filesystem::create_directory(missing, failure);
  if (failure) throw Error(ErrorKind::command_line, missing.string(), "this folder can't be made", "name another place by --out");
  std::filesystem::remove(missing, failure);
}

// Where nothing can encode a video its pictures are written.
RunOptions drawable(RunOptions options) {
  if (options.video.empty() || VideoFile::has_encoder()) return options;
  options.video.clear();
  options.frames = FrameFormat::png;
  return options;
}

}  // namespace

std::filesystem::path folder_of(const RunOptions& options) {
  return options.out.empty() ? std::filesystem::path("out") / options.scene.stem() : options.out;
}

int run(const RunOptions& given) {
  std::optional<Checkpoint> from;
  if (!given.resume.empty()) from = load_checkpoint(given.resume);
  const RunOptions options = from ? resumed_options(given, *from) : drawable(given);
  if (!options.check || !options.out.empty()) expect_folder(folder_of(options));
  const std::unique_ptr<PreparedRun> run = prepare_run(options);
  PreparedRun& prepared = *run;
  if (from) resume(given, *from, prepared);
  if (!given.video.empty() && options.video.empty())
    prepared.warnings.push_back("--video: there is no ffmpeg on PATH: frames are written as PNG files instead; install ffmpeg");
  for (const std::string& warning : prepared.warnings) fmt::print(stderr, "pliant: warning: {}\n", warning);
  if (options.check) {
    show_check(prepared);
    return 0;
  }
  watch_for_interrupts();
  return Run(options, prepared, from ? &*from : nullptr).execute();
}

}  // namespace pliant::app
