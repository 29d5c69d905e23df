#include "run/driven_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/bytes.hpp"
#include "core/checksum.hpp"
#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/thread_pool.hpp"
#include "core/version.hpp"
#include "device/gpu/gpu_device.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "gl/context.hpp"
#include "scene/scene_text.hpp"
#include "simulation/start_check.hpp"

namespace pliant {
namespace {

constexpr double time_rounding = 1e-9;  // by this part of a step or frame its time may seem later than a goal

// What save() returns, but for its checksum.
struct Saved {
  std::string version;
  std::uint64_t fingerprint = 0;  // of the scene
  int precision = 32;
  std::uint64_t step = 0;
  double time = 0;
  std::vector<Material> materials;
  std::string simulation;
};

template <class Archive, class Held>
void visit_saved(Archive& archive, Held& held) {
  auto& [version, fingerprint, precision, step, time, materials, simulation] = held;
  archive(version, fingerprint, precision, step, time, materials, simulation);
}

Error not_restored(const std::string& problem, const std::string& remedy) {
  return {ErrorKind::input, "restore", problem, remedy};
}

Saved read_saved(std::string_view bytes) {
  if (bytes.size() < sizeof(std::uint64_t)) throw not_restored("these are no bytes of save()", "pass what save() returned");
  const std::string_view content = bytes.substr(sizeof(std::uint64_t));
  if (ByteReader(bytes).get<std::uint64_t>() != checksum(content))
    throw not_restored("the bytes are damaged, or not of save()", "pass what save() returned");
  ByteReader from(content);
  Saved saved;
  visit_saved(from, saved);
  return saved;
}

class Stopped {
 public:
  explicit Stopped(const DrivenRun::Stops& stops) : stops_(stops) {}
  // Asks, unless it knows already.
  bool operator()() { return stopped_ = stopped_ || (stops_ && stops_()); }
  [[nodiscard]] bool is_known() const { return stopped_; }

 private:
  const DrivenRun::Stops& stops_;
  bool stopped_ = false;
};

}  // namespace

DrivenRun::DrivenRun(const RunOptions& options) : run_(prepare_run(options)) {
  if (gpu::context_of(*run_->device) != nullptr) owner_ = std::this_thread::get_id();
}

// What OpenGL has made goes in its own context.
DrivenRun::~DrivenRun() {
  painter_.reset();
  enter();
}

void DrivenRun::enter() {
  if (is_of_another_thread())
    throw Error(ErrorKind::device, "", "the simulation uses OpenGL, so it belongs to another thread",
                "use it in the thread that made it, or that drew first");
  if (gl::Context* context = gpu::context_of(*run_->device)) context->make_current();
}

double DrivenRun::next_frame(double time) const {
  const double rate = run_->plan.frame_rate;
  return (std::floor(time * rate + time_rounding) + 1) / rate;
}

void DrivenRun::advance(std::uint64_t steps, const Stops& stops) {
  enter();
  if (run_->plan.tolerance) return advance_adaptive(steps, stops);
  if (steps == 1) return run_->simulation->advance(1);
  using Clock = std::chrono::steady_clock;
  Stopped stopped(stops);
  for (std::uint64_t left = steps; left > 0;) {
    const std::uint64_t made = std::min(left, batch_.steps());
    const auto begin = Clock::now(),
               end = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(Batch::time));
    run_->simulation->advance(made, [&] { return Clock::now() > end && stopped(); });
    if (stopped.is_known()) return;
    batch_.took(std::chrono::duration<double>(Clock::now() - begin).count());
    left -= made;
    if (left > 0 && (stopped() || has_broken_down())) return;
  }
}

void DrivenRun::advance_adaptive(std::uint64_t steps, const Stops& stops) {
  StepReport now = run_->simulation->report();
  const std::uint64_t target = now.steps + steps;
  while (now.steps < target && !now.breakdown) {
    const double to = next_frame(base_time_ + now.time) - base_time_;
    now = run_->simulation->advance_toward(to, std::min(target - now.steps, Simulation::most_steps_at_once));
    if (stops && stops()) return;
  }
}

void DrivenRun::advance_to(double time, const Stops& stops) {
  StepReport now = report();
  const double spare = time_rounding / run_->plan.frame_rate;
  if (!(time >= now.time - spare))
    throw Error(ErrorKind::input, "advance_to", fmt::format("{:.9g} s is before now, {:.9g} s", time, now.time),
                "go back by restore(), or make another simulation");
  if (!run_->plan.tolerance) {
    const auto made = static_cast<double>(now.steps - base_step_);  // the one in hand is none of them
    const double steps = std::round((time - base_time_) / run_->plan.time_step) - made;
    if (!(steps < 1e18)) throw Error(ErrorKind::input, "advance_to", fmt::format("{:.9g} s takes too many steps", time), "");
    return advance(static_cast<std::uint64_t>(std::max(steps, 0.0)), stops);
  }
  const double target = time - base_time_;  // by the simulation's own clock, because its steps end at such times to the bit
  for (now = run_->simulation->report(); now.time < target && !now.breakdown;) {
    now = run_->simulation->advance_toward(std::min(next_frame(base_time_ + now.time) - base_time_, target));
    if (stops && stops()) return;
  }
}

bool DrivenRun::has_broken_down() {
  enter();
  return run_->simulation->has_broken_down();
}

StepReport DrivenRun::report() {
  enter();
  StepReport report = run_->simulation->report();
  report.steps += base_step_;
  report.time += base_time_;
  if (report.breakdown) report.breakdown->step += base_step_;
  return report;
}

const State& DrivenRun::state() {
  enter();
  run_->simulation->read_state(state_);
  return state_;
}

Measurement DrivenRun::measure() {
  enter();
  if (!pool_) pool_ = std::make_unique<ThreadPool>(run_->device->info().threads);
  if (!meter_) meter_ = std::make_unique<Meter>(run_->start.model);
  return meter_->measure(state(), run_->scene.simulation.gravity, *pool_);
}

Simulation& DrivenRun::simulation() {
  enter();
  return *run_->simulation;
}

std::unique_ptr<PreparedRun> DrivenRun::with(Model model, const State& state) const {
  auto made = std::make_unique<PreparedRun>();
  PreparedRun& run = *made;
  run.working_folder = run_->working_folder;
  run.scene_text = run_->scene_text;
  run.scene = run_->scene;
  run.mesh_checksums = run_->mesh_checksums;
  run.start = {std::move(model), run_->start.state};
  run.warnings = run_->warnings;
  choose_force_sums(run.start.model, run_->device->info().kind);
  run.plan = plan_time(run.scene, run.start.model);
  expect_carried(run.scene, run.plan, run_->device->precision());
  run.simulation = std::make_unique<Simulation>(*run_->device, run.start.model, state, run.plan, run.scene.collision);
  return made;
}

// The device goes along. What drew and measured the model before is gone.
void DrivenRun::take(std::unique_ptr<PreparedRun> run, std::uint64_t steps, double time) {
  painter_.reset();
  meter_.reset();
  enter();
  run_->simulation.reset();
  run->device = std::move(run_->device);
  run_ = std::move(run);
  base_step_ = steps;
  base_time_ = time;
}

// Scripted bodies keep the paths that they were sent along.
void DrivenRun::go_on_with(Model model, const State& state) {
  const StepReport now = report();
  if (now.breakdown)
    throw Error(ErrorKind::input, "", "numbers have gone wrong, so the simulation can't go on",
                "restore() what save() returned before");
  run_->simulation->copy_path_keys(model);
  auto run = with(std::move(model), state);
  expect_still_apart(*run->simulation, run->start.model, run->scene.collision, "the state");
  take(std::move(run), now.steps, now.time);
}

void DrivenRun::go_on_with(const State& state) {
  enter();
  go_on_with(run_->start.model, state);
}

void DrivenRun::go_on_with(std::span<const Material> materials) {
  enter();
  go_on_with(with_materials(run_->start.model, materials), state());
}

void DrivenRun::pull(const Pull& by, double seconds) {
  PLIANT_EXPECT(by.vertex < model().vertex_count());
  const ModelBody& body = model().body_of(by.vertex);
  if (body.is_rigid() || body.stiffness == 0)
    throw Error(ErrorKind::input, "pull", fmt::format("body \"{}\" has no springs to pull by", body.name), "pull a soft body");
  enter();
  run_->simulation->pull(by, seconds);
}

void DrivenRun::send(std::uint32_t b, const glm::dvec3& target, double seconds) {
  PLIANT_EXPECT(b < model().bodies.size());
  const ModelBody& body = model().bodies[b];
  if (!body.path || body.path->way.repeats != 0 || scene().bodies[b].path.empty())
    throw Error(ErrorKind::input, "send", fmt::format("body \"{}\" has no path that ends, so it can't be sent", body.name),
                "make it scripted, with a path of two keys or more that does not repeat");
  enter();
  run_->simulation->send(b, keys_toward(*body.path, run_->simulation->path_state(b), target, seconds));
}

std::uint64_t DrivenRun::fingerprint() const {
  return checksum(std::as_bytes(std::span(run_->mesh_checksums)),
                  checksum(scene_text(run_->scene, run_->scene.file.parent_path())));
}

std::string DrivenRun::save() {
  enter();
  const Saved saved{.version = full_version(),
                    .fingerprint = fingerprint(),
                    .precision = run_->device->precision(),
                    .step = base_step_,
                    .time = base_time_,
                    .materials = materials_of(model()),
                    .simulation = run_->simulation->save()};
  ByteWriter content;
  visit_saved(content, saved);
  const std::string bytes = content.take();
  ByteWriter to;
  to.put(checksum(bytes));
  return to.take() + bytes;
}

void DrivenRun::restore(std::string_view bytes) {
  const Saved saved = read_saved(bytes);
  if (saved.version != full_version())
    throw not_restored(fmt::format("pliant {} has saved it, and this is {}", saved.version, full_version()),
                       "use the pliant that saved it");
  if (saved.fingerprint != fingerprint()) throw not_restored("it is of another scene", "restore a simulation of the same scene");
  enter();
  if (saved.materials == materials_of(model()) && saved.precision == run_->device->precision()) {
    run_->simulation->restore(saved.simulation);
    base_step_ = saved.step;
    base_time_ = saved.time;
    return;
  }
  auto run = with(with_materials(run_->start.model, saved.materials), run_->start.state);
  run->simulation->restore(saved.simulation);
  if (saved.precision > run_->device->precision())
    expect_provable(*run->simulation, run->start.model, run->scene.collision, "restore");
  take(std::move(run), saved.step, saved.time);
}

render::Image DrivenRun::render(const OutputDescription& output) {
  enter();
  owner_ = std::this_thread::get_id();
  if (!painter_ || painted_ != output) {
    painter_.reset();
    painter_ = std::make_unique<Painter>(*run_, output, "render");
    painted_ = output;
  }
  return painter_->paint();
}

}  // namespace pliant
