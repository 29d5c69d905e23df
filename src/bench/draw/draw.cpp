#include "bench/draw/draw.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "bench/common/step_cases.hpp"
#include "bench/common/timing.hpp"
#include "core/stopwatch.hpp"
#include "device/gpu/gpu_device.hpp"
#include "gl/context.hpp"
#include "render/frame_renderer.hpp"
#include "simulation/simulation.hpp"
#include "view/playback.hpp"

namespace pliant::bench {
namespace {

constexpr int marked_frames = 21, quick_marked_frames = 3;
constexpr double enough_time = 1;        // for marked frames [s]; three are made in any case
constexpr double a_sixtieth = 1.0 / 60;  // [s]
constexpr double warming_time = 0.3;     // [s]; clocks rise under load

// A scene that is drawn from the buffers in which it is simulated.
class Drawing {
 public:
  Drawing(Device& device, const StepCase& what, const render::RenderOptions& options)
      : device_(device),
        simulation_(device, what.start.model, what.start.state, what.plan, what.collision),
        start_(simulation_.save()),
        renderer_(what.start.model, options) {}

  void restart() { simulation_.restore(start_); }
  void step(std::uint64_t steps) { simulation_.advance(steps); }
  [[nodiscard]] bool is_broken() { return simulation_.report().breakdown.has_value(); }
  void draw(const render::PassObserver& after_pass = {}) {
    renderer_.draw(gpu::gl_buffer_of(device_, simulation_.position_buffer()), simulation_.first_position(), after_pass);
  }

 private:
  Device& device_;
  Simulation simulation_;
  std::string start_;
  render::FrameRenderer renderer_;
};

using PassTimes = std::vector<std::pair<std::string, double>>;

// Returns the times of a frame's passes [ms], by a mark after each.
PassTimes time_passes(Device& device, Drawing& drawing) {
  PassTimes passes;
  device.mark_time();
  drawing.draw([&](const char* pass) {
    device.mark_time();
    passes.emplace_back(pass, 0);
  });
  const std::vector<double> marks = device.take_times();
  for (std::size_t k = 0; k < passes.size(); ++k) passes[k].second = 1e3 * (marks[k + 1] - marks[k]);
  return passes;
}

PassTimes median_passes(Device& device, Drawing& drawing, int frames) {
  std::vector<PassTimes> measured;
  double passed = 0;
  for (int frame = 0; frame < frames && (frame < quick_marked_frames || passed < enough_time); ++frame) {
    measured.push_back(time_passes(device, drawing));
    for (const auto& [pass, milliseconds] : measured.back()) passed += 1e-3 * milliseconds;
  }
  PassTimes medians = measured.front();
  for (std::size_t pass = 0; pass < medians.size(); ++pass) {
    std::vector<double> times;
    for (const PassTimes& frame : measured) times.push_back(frame[pass].second);
    medians[pass].second = median(std::move(times));
  }
  return medians;
}

// Returns the wall time of steps from the start [s]. With `draws` it includes a picture of the last step.
double seconds_of(Device& device, Drawing& drawing, std::uint64_t steps, bool draws) {
  drawing.restart();
  device.finish();
  Stopwatch watch;
  watch.time([&] {
    drawing.step(steps);
    if (draws) drawing.draw();
    device.finish();
  });
  return watch.seconds();
}

std::optional<double> steps_lost(Device& device, Drawing& drawing, int rounds) {
  seconds_of(device, drawing, 1, true);  // builds the kernels
  const double steps_of_a_picture = a_sixtieth / seconds_of(device, drawing, 1, false);
  if (steps_of_a_picture < 1) return std::nullopt;
  std::vector<double> with, without;
  for (int round = 0; round < rounds; ++round)
    for (const bool draws : {false, true})
      (draws ? with : without).push_back(seconds_of(device, drawing, static_cast<std::uint64_t>(steps_of_a_picture), draws));
  if (drawing.is_broken()) return std::nullopt;
  return share_lost(median(std::move(with)), median(std::move(without)));
}

// Plays the scene from its start to its end, or for so long a time. A picture begins when the display has shown the one before.
Played play(Device& device, Drawing& drawing, const TimePlan& plan) {
  using Clock = std::chrono::steady_clock;
  constexpr double longest_play = 20;  // [s]
  drawing.restart();
  device.finish();
  view::Playback playback({});
  view::BatchSize batch;
  Played played;
  Stopwatch simulating, drawn;
  std::uint64_t made = 0;
  bool is_broken = false;
  const auto start = Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const auto time_of_steps = [&](std::uint64_t steps) { return static_cast<double>(steps) * plan.time_step; };
  const auto is_due = [&] { return made < plan.steps && time_of_steps(made + 1) <= playback.goal() + 1e-6 * plan.time_step; };
  const auto step = [&] {
    double clock = now();
    playback.begin(clock, time_of_steps(made));
    while (!is_broken && is_due() && playback.has_time(clock)) {
      const double due = (playback.goal() - time_of_steps(made)) / plan.time_step + 1e-6;
      const double most = static_cast<double>(std::min(batch.steps(), plan.steps - made));
      const auto steps = static_cast<std::uint64_t>(std::clamp(due, 1.0, most));  // one is due, though `due` may round to less
      drawing.step(steps);
      is_broken = drawing.is_broken();
      made += steps;
      const double since = std::exchange(clock, now());
      batch.took(clock - since);
    }
    playback.end(clock, time_of_steps(made), !is_due());
  };
  while (made < plan.steps && now() < longest_play && !is_broken) {
    const double began = now();
    simulating.time(step);
    drawn.time([&] {
      drawing.draw();
      device.finish();
    });
    const double picture = now() - began;
    ++played.pictures;
    played.late += picture > a_sixtieth ? 1 : 0;
    played.slowest_picture_milliseconds = std::max(played.slowest_picture_milliseconds, 1e3 * picture);
    const double shown = a_sixtieth * std::ceil(now() / a_sixtieth);
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(shown)));
  }
  played.seconds_dropped = playback.dropped();
  if (played.pictures > 0) {
    played.simulation_milliseconds = 1e3 * simulating.seconds() / played.pictures;
    played.drawing_milliseconds = 1e3 * drawn.seconds() / played.pictures;
  }
  return played;
}

void warm_up(Device& device, Drawing& drawing) {
  Stopwatch watch;
  while (watch.seconds() < warming_time)
    watch.time([&] {
      drawing.draw();
      device.finish();
    });
}

DrawRow measure(Device& device, const StepCase& what, const DrawOptions& options, bool is_cold) {
  const Model& model = what.start.model;
  const render::Detail detail = render::live_detail(gpu::context_of(device)->adapter().is_software);
  Drawing drawing(device, what, render::live_options(model, what.start.state, what.output, options.size, detail));
  const int frames = options.quick ? quick_marked_frames : marked_frames;
  drawing.draw();  // builds the programs
  device.finish();
  if (is_cold) warm_up(device, drawing);
  const Timing frame = seconds_each(device, options.quick ? quick_effort : Effort{}, [&] { drawing.draw(); });
  PassTimes passes = median_passes(device, drawing, frames);
  return {.scene = what.name,
          .vertices = model.vertex_count(),
          .triangles = static_cast<std::uint32_t>(model.triangles.size()),
          .bodies = static_cast<std::uint32_t>(model.bodies.size()),
          .clustered_bodies = clustered_bodies(model),
          .detail = detail == render::Detail::full ? "full" : "reduced",
          .width = options.size.x,
          .height = options.size.y,
          .milliseconds_per_frame = 1e3 * frame.median,
          .fastest_milliseconds_per_frame = 1e3 * frame.fastest,
          .steps_lost = frame.median < a_sixtieth && !options.quick ? steps_lost(device, drawing, frames) : std::nullopt,
          .played = options.quick || what.plan.tolerance ? std::nullopt : std::optional(play(device, drawing, what.plan)),
          .milliseconds = std::move(passes)};
}

}  // namespace

double share_lost(double seconds_with_picture, double seconds_without) {
  return (seconds_with_picture - seconds_without) / a_sixtieth;
}

DrawResult bench_draw(const DrawOptions& options, const Progress& progress) {
  StepCases all = load_step_cases(options.scenes, options.quick);
  DrawResult result{.rows = {}, .notes = std::move(all.notes), .interrupted = false};
  const auto device = open({.device = DeviceKind::gpu, .gpu_index = options.gpu_index});
  choose_force_sums(all, DeviceKind::gpu);
  for (const StepCase& what : all.cases) {
    const double part = static_cast<double>(result.rows.size()) / static_cast<double>(all.cases.size());
    result.interrupted = !progress(part, what.name);
    if (result.interrupted) return result;
    result.rows.push_back(measure(*device, what, options, result.rows.empty()));
  }
  progress(1, "");
  return result;
}

}  // namespace pliant::bench
