#include "view/session.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"

namespace pliant::view {
namespace {

constexpr double rounding = 1e-9;  // of a step or a frame, by which its time may seem to be later than a goal

bool is_obj(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".obj";
}

SceneDescription lone_body(const std::filesystem::path& file) {
  SceneDescription scene;
  scene.file = file;
  BodyDescription& body = scene.bodies.emplace_back();
  body.name = file.stem().string();
  body.mesh = file.filename().string();
  return scene;
}

}  // namespace

SceneDescription describe(const std::filesystem::path& file, std::span<const std::string> overrides) {
  SceneDescription scene = is_obj(file) ? lone_body(file) : load_scene(file, overrides);
  if (scene.title.empty()) scene.title = file.stem().string();
  return scene;
}

Session::Session(Device& device, SceneDescription scene, std::size_t most_history_bytes)
    : device_(device),
      scene_(std::move(scene)),
      start_(build_model(load_bodies(scene_, &warnings_), scene_.simulation.gravity)),
      plan_(plan_time(scene_, start_.model)),
      history_(most_history_bytes) {
  expect_carried(scene_, plan_, device.precision());
  restart();
}

double Session::time() const { return plan_.tolerance ? base_time_ + report_.time : time_of_step(step()); }

std::uint64_t Session::next_frame() const {
  return static_cast<std::uint64_t>(std::floor(time() * plan_.frame_rate + rounding)) + 1;
}

bool Session::is_before(double time) const {
  if (report_.non_finite) return false;
  if (plan_.tolerance) return time_of_frame(next_frame()) <= time + rounding / plan_.frame_rate;
  return time_of_step(step() + 1) <= time + rounding * plan_.time_step;
}

void Session::advance_toward(double time, std::uint64_t most_steps) {
  if (!is_before(time)) return;
  if (plan_.tolerance) {
    report_ = simulation_->advance_toward(time_of_frame(next_frame()) - base_time_, most_steps);
    return;
  }
  const double due = std::floor(time / plan_.time_step + rounding) - static_cast<double>(step());
  simulation_->advance(std::min(most_steps, static_cast<std::uint64_t>(std::max(due, 1.0))));
  report_ = simulation_->report();
}

void Session::step_once() {
  const std::uint64_t before = step();
  const double due = plan_.tolerance ? time_of_frame(next_frame()) : time_of_step(before + 1);
  while (step() == before && !report_.non_finite) advance_toward(due, 1);  // what a tolerance rejects is no step
}

void Session::record() {
  if (!report_.non_finite) history_.record({step(), time(), simulation_->state()});
}

bool Session::step_back() {
  const Snapshot* found = history_.before(step());
  if (found == nullptr) return false;
  const std::uint64_t wanted = plan_.tolerance ? found->step : step() - 1;
  start_from(found->state, found->step, found->time);
  while (step() < wanted) {
    step_once();
    record();
  }
  return true;
}

void Session::restart() {
  history_.clear();
  start_from(start_.state, 0, 0);
  record();
}

void Session::start_from(const State& state, std::uint64_t step, double time) {
  simulation_.reset();  // its buffers make room for the same again
  simulation_ = std::make_unique<Simulation>(device_, start_.model, state, plan_, scene_.collision);
  report_ = simulation_->report();
  base_step_ = step;
  base_time_ = time;
}

}  // namespace pliant::view
