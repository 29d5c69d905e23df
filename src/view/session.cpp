#include "view/session.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/extension.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "mesh/generators.hpp"
#include "model/load_bodies.hpp"
#include "render/camera.hpp"
#include "scene/load_scene.hpp"
#include "simulation/start_check.hpp"

namespace pliant::view {
namespace {

constexpr double rounding = 1e-9;  // by this part of a step or frame its time may seem later than a goal

bool is_obj(const std::filesystem::path& file) { return extension_of(file) == ".obj"; }

SceneDescription lone_body(const std::filesystem::path& file) {
  SceneDescription scene;
  scene.file = file;
  BodyDescription& body = scene.bodies.emplace_back();
  body.name = file.stem().string();
  body.mesh = file.filename().string();
  return scene;
}

LoadedScene with_settings(const LoadedScene& scene, const Settings& wanted) {
  LoadedScene changed = scene;
  SimulationDescription& simulation = changed.description.simulation;
  simulation.integrator.value = wanted.integrator;
  simulation.time_step = wanted.time_step;
  simulation.tolerance = wanted.tolerance;
  simulation.damping_law = wanted.damping_law;
  changed.description.collision.elasticity = wanted.elasticity;
  changed.description.collision.friction = wanted.friction;
  changed.description.collision.restitution = wanted.restitution;
  changed.start.model = with_materials(std::move(changed.start.model), wanted.materials);
  return changed;
}

constexpr const char* hand_name = "hand";

// To and fro, ever less, and up a little.
std::vector<PathKeyDescription> shake_of(const ModelBody& container) {
  const double far = 0.15 * container.radius;
  std::vector<PathKeyDescription> keys = {{.time = 0}};
  for (const double part : {1.0, -1.0, 0.8, -0.6, 0.4, -0.2})
    keys.push_back({.time = keys.back().time + 0.16, .position = {part * far, 0.25 * std::abs(part) * far, 0}});
  keys.push_back({.time = keys.back().time + 0.16});
  return keys;
}

LoadedScene settled(LoadedScene scene, const Device& device) {
  choose_force_sums(scene.start.model, device.info().kind);
  return scene;
}

std::unique_ptr<Simulation> make_simulation(Device& device, const LoadedScene& scene, const State& from, const TimePlan& plan) {
  return std::make_unique<Simulation>(device, scene.start.model, from, plan, scene.description.collision);
}

}  // namespace

Settings settings_of(const LoadedScene& scene) {
  const SimulationDescription& of = scene.description.simulation;
  const CollisionDescription& contacts = scene.description.collision;
  return {.integrator = of.integrator.value,
          .time_step = of.time_step,
          .tolerance = of.tolerance,
          .damping_law = damping_law_of(scene.description),
          .elasticity = elasticity_of(contacts),
          .friction = contacts.friction,
          .restitution = contacts.restitution,
          .materials = materials_of(scene.start.model)};
}

LoadedScene load(const std::filesystem::path& file, std::span<const std::string> overrides) {
  if (is_obj(file) && !overrides.empty())
    throw Error(ErrorKind::command_line, "--set", "an OBJ file has no keys to set", "write a scene file that names the mesh");
  LoadedScene scene{.description = is_obj(file) ? lone_body(file) : load_scene(file, overrides), .start = {}, .warnings = {}};
  if (scene.description.title.empty()) scene.description.title = file.stem().string();
  scene.start = build_model(load_bodies(scene.description, &scene.warnings), scene.description.simulation.gravity,
                            scene.description.grounds);
  return scene;
}

Session::Session(Device& device, LoadedScene scene, std::size_t most_history_bytes)
    : device_(&device),
      scene_(std::make_unique<const LoadedScene>(settled(std::move(scene), device))),
      plan_(plan_time(scene_->description, scene_->start.model)),
      history_(most_history_bytes) {
  expect_carried(scene_->description, plan_, device.precision());
  restart();
  expect_apart(*simulation_, model(), scene_->description.collision, scene_->description.file.string());
}

double Session::time() const { return plan_.tolerance ? base_time_ + report_.time : time_of_step(step()); }

std::optional<Breakdown> Session::breakdown() const {
  std::optional<Breakdown> found = report_.breakdown;
  if (found) found->step += base_step_;
  return found;
}

std::uint64_t Session::next_frame() const {
  return static_cast<std::uint64_t>(std::floor(time() * plan_.frame_rate + rounding)) + 1;
}

bool Session::is_due(double time) const {
  if (report_.breakdown) return false;
  if (plan_.tolerance) return time_of_frame(next_frame()) <= time + rounding / plan_.frame_rate;
  return time_of_step(step() + 1) <= time + rounding * plan_.time_step;
}

void Session::advance_toward(double time, std::uint64_t most_steps) {
  if (!is_due(time)) return;
  const double before = this->time();
  make_due_steps(time, most_steps);
  if (pull_) simulation_->pull(*pull_, this->time() - before);
}

void Session::make_due_steps(double time, std::uint64_t most_steps) {
  const std::uint64_t before = report_.steps;
  report_ = stepping_.time([&] { return advance(time, most_steps); });
  steps_made_ += report_.steps - before;
}

StepReport Session::advance(double time, std::uint64_t most_steps) {
  if (plan_.tolerance) return simulation_->advance_toward(time_of_frame(next_frame()) - base_time_, most_steps);
  const double due = std::floor((time - base_time_) / plan_.time_step + rounding) - static_cast<double>(report_.steps);
  simulation_->advance(static_cast<std::uint64_t>(std::clamp(due, 1.0, static_cast<double>(most_steps))));
  return simulation_->report();
}

void Session::step_once() {
  const std::uint64_t before = step();
  const double due = plan_.tolerance ? time_of_frame(next_frame()) : time_of_step(before + 1);
  while (step() == before && !report_.breakdown) advance_toward(due, 1);  // a tolerance may reject some
}

void Session::record() {
  if (!report_.breakdown) history_.record({step(), simulation_->save()});
}

// Goes to the snapshot before and steps on from there. Of a long way it records only the last steps. Earlier ones are made again
// when they are reached, so that older snapshots keep about half of the memory.
bool Session::step_back() {
  const Snapshot* found = history_.before(step());
  if (found == nullptr) return false;
  const std::uint64_t most_kept = std::clamp<std::uint64_t>(history_.most_bytes() / 2 / found->bytes(), 1, 32);
  const std::uint64_t wanted = step() - 1;
  const std::optional<Pull> pulled = std::exchange(pull_, std::nullopt);
  go_to(found->saved);
  while (step() < wanted && !report_.breakdown) {
    step_once();
    if (wanted - step() < most_kept) record();
  }
  pull_ = pulled;
  return true;
}

void Session::restart() {
  if (before_edits_) {
    const TimePlan plan = plan_time(before_edits_->description, before_edits_->start.model);
    auto simulation = make_simulation(*device_, *before_edits_, before_edits_->start.state, plan);
    plan_ = plan;
    begin_with(std::move(simulation), 0, 0);
    scene_ = std::move(before_edits_);
    beginning_ = simulation_->save();
    hand_.reset();
    bodies_are_others();
  } else if (beginning_.empty()) {
    begin_with(simulation_on(*device_, scene_->start.state), 0, 0);
    beginning_ = simulation_->save();
  } else {
    go_to(beginning_);
  }
  history_.clear();
  record();
}

double Session::radius() const {
  const ModelAndState& start = unedited().start;
  return render::box_around(start.state.world_positions(start.model)).radius();
}

void Session::change(const Settings& wanted) {
  const bool starts_anew = report_.breakdown.has_value();
  LoadedScene changed = with_settings(starts_anew ? *scene_ : scene_now(), wanted);
  if (starts_anew && hand_) lay_hand_down(changed.start);
  const State from = starts_anew ? changed.start.state : simulation_->state();
  std::unique_ptr<const LoadedScene> before;
  if (before_edits_) before = std::make_unique<const LoadedScene>(with_settings(*before_edits_, settings_before_edits(wanted)));
  go_on_with(std::move(changed), from, starts_anew);
  if (before) before_edits_ = std::move(before);
}

// Materials of bodies that are there no more stay as they were.
Settings Session::settings_before_edits(const Settings& wanted) const {
  Settings settings = wanted;
  settings.materials = settings_of(*before_edits_).materials;
  for (std::size_t b = 0; b < settings.materials.size(); ++b) {
    const auto same = std::ranges::find(model().bodies, before_edits_->start.model.bodies[b].name, &ModelBody::name);
    if (same != model().bodies.end())
      settings.materials[b] = wanted.materials[static_cast<std::size_t>(same - model().bodies.begin())];
  }
  return settings;
}

LoadedScene Session::scene_now() const {
  LoadedScene now = *scene_;
  simulation_->copy_path_keys(now.start.model);
  return now;
}

void Session::lay_hand_down(ModelAndState& start) const {
  for (physics::PathKey& key : start.model.bodies[hand_->body].path->keys) {
    std::ranges::copy(start.state.poses[hand_->body].origin, key.position);
    std::ranges::fill(key.velocity, 0.0);
  }
}

void Session::bodies_are_others() {
  pull_.reset();
  ++bodies_version_;
}

void Session::go_on_with(LoadedScene scene, const State& from, bool starts_anew) {
  auto changed = std::make_unique<const LoadedScene>(settled(std::move(scene), *device_));
  const TimePlan plan = plan_time(changed->description, changed->start.model);
  expect_carried(changed->description, plan, device_->precision());
  auto simulation = make_simulation(*device_, *changed, from, plan);
  const std::string place = changed->description.file.string();
  if (starts_anew)
    expect_apart(*simulation, changed->start.model, changed->description.collision, place);
  else
    expect_still_apart(*simulation, changed->start.model, changed->description.collision, place);
  const double at_time = starts_anew ? 0 : time();
  plan_ = plan;
  begin_with(std::move(simulation), starts_anew ? 0 : step(), at_time);
  scene_ = std::move(changed);
  history_.clear();
  beginning_ = starts_anew ? simulation_->save() : "";
  record();
}

void Session::go_on_with_bodies(LoadedScene changed, const State& from) {
  if (report_.breakdown)
    throw Error(ErrorKind::input, "", "the state is not finite, so its bodies can't change", "go back, or to the start");
  std::unique_ptr<const LoadedScene> before = before_edits_ ? nullptr : std::make_unique<const LoadedScene>(*scene_);
  go_on_with(std::move(changed), from, false);
  if (before) before_edits_ = std::move(before);
  bodies_are_others();
}

std::uint32_t Session::add(const BodySetup& setup) {
  LoadedScene changed = scene_now();
  std::vector<BodyDescription>& descriptions = changed.description.bodies;
  const auto place = std::ranges::find(descriptions, true, &BodyDescription::is_container);
  const auto index = static_cast<std::size_t>(place - descriptions.begin());
  const glm::dvec3 gravity = changed.description.simulation.gravity;
  const ModelAndState now = with_body({scene_->start.model, simulation_->state()}, index, setup, gravity);
  changed.start = with_body(changed.start, index, setup, gravity);
  descriptions.insert(place, setup.description);
  go_on_with_bodies(std::move(changed), now.state);
  if (hand_ && index <= hand_->body) ++hand_->body;
  return static_cast<std::uint32_t>(index);
}

void Session::remove(std::uint32_t body) {
  PLIANT_EXPECT(body < model().bodies.size());
  const bool is_last = std::ranges::count_if(model().bodies, [](const ModelBody& b) { return !b.is_rigid(); }) == 1;
  if (is_last && !model().bodies[body].is_rigid())
    throw Error(ErrorKind::input, model().bodies[body].name, "is the last soft body", "leave it there");
  LoadedScene changed = scene_now();
  const ModelAndState now = without_body({scene_->start.model, simulation_->state()}, body);
  changed.start = without_body(changed.start, body);
  changed.description.bodies.erase(changed.description.bodies.begin() + body);
  go_on_with_bodies(std::move(changed), now.state);
  if (hand_ && hand_->body == body)
    hand_.reset();
  else if (hand_ && body < hand_->body)
    --hand_->body;
}

void Session::shake() {
  LoadedScene changed = scene_now();
  bool has_changed = false;
  for (std::size_t b = 0; b < changed.start.model.bodies.size(); ++b) {
    ModelBody& body = changed.start.model.bodies[b];
    BodyDescription& description = changed.description.bodies[b];
    if (!body.is_container) continue;
    if (body.path) {
      const auto index = static_cast<std::uint32_t>(b);
      const bool is_shaken = description.path == shake_of(body);  // now or before
      if (is_shaken && simulation_->path_state(index).time >= body.path->keys.back().time)
        simulation_->send(index, body.path->keys);
      continue;
    }
    description.path = shake_of(body);
    const physics::Pose& pose = changed.start.state.poses[b];
    const glm::dvec3 arm = physics::rotate_back(pose, glm::make_vec3(pose.origin) - description.position);
    description.kind = body.kind = BodyKind::scripted;
    body.path = make_path(description, arm);
    has_changed = true;
  }
  if (has_changed) go_on_with_bodies(std::move(changed), simulation_->state());
}

void Session::put_hand(const glm::dvec3& place, double radius) {
  PLIANT_EXPECT(!hand_);
  BodySetup setup{generate_mesh("icosphere:2"), {}};
  BodyDescription& description = setup.description;
  description.name = hand_name;
  description.kind = BodyKind::scripted;
  description.mesh = "icosphere:2";
  description.scale = radius;
  description.position = place;
  description.path = {{.time = 0}, {.time = 1}};
  description.color = {0.9, 0.75, 0.65};
  const std::uint32_t body = add(setup);
  hand_ = Hand{body, radius};
}

void Session::take_hand() {
  if (hand_) remove(hand_->body);
}

void Session::send_hand(const glm::dvec3& target, double seconds) {
  PLIANT_EXPECT(hand_ && seconds > 0);
  const physics::PathState now = simulation_->path_state(hand_->body);
  simulation_->send(hand_->body, keys_toward(*model().bodies[hand_->body].path, now, target, seconds));
}

void Session::time_passes(bool timed) { simulation_->time_passes(times_passes_ = timed); }

void Session::move_to(Device& device) {
  PLIANT_EXPECT(device.precision() == device_->precision());
  auto scene = std::make_unique<const LoadedScene>(settled(*scene_, device));
  std::unique_ptr<Simulation> moved = make_simulation(device, *scene, scene->start.state, plan_);
  moved->restore(simulation_->save());
  simulation_ = std::move(moved);
  scene_ = std::move(scene);
  if (before_edits_) before_edits_ = std::make_unique<const LoadedScene>(settled(*before_edits_, device));
  simulation_->time_passes(times_passes_);
  device_ = &device;
}

std::unique_ptr<Simulation> Session::simulation_on(Device& device, const State& from) const {
  return make_simulation(device, *scene_, from, plan_);
}

void Session::begin_with(std::unique_ptr<Simulation> simulation, std::uint64_t step, double time) {
  simulation_ = std::move(simulation);
  simulation_->time_passes(times_passes_);
  report_ = simulation_->report();
  base_step_ = step;
  base_time_ = time;
}

void Session::go_to(std::string_view saved) {
  simulation_->restore(saved);
  report_ = simulation_->report();
}

}  // namespace pliant::view
