#include "bench/precision/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"

namespace pliant::bench {
namespace {

constexpr glm::dvec3 squash{0.8, 1.05, 1.1};  // stretch at the start

BodySetup sphere(int level) {
  BodySetup setup;
  setup.mesh = generate_mesh(fmt::format("icosphere:{}", level));
  setup.description.name = "sphere";
  setup.description.stretch = squash;
  return setup;
}

double omega_of(const Model& model) {
  double omega = 0;
  for (const ModelBody& body : model.bodies) omega = std::max(omega, stiffest_frequency(body));
  return omega;
}

double omega_of(const BodySetup& setup) { return omega_of(build_model({&setup, 1}, glm::dvec3(0.0)).model); }

// `phase` is omega times the duration [rad], `reference_step` omega times the coarser reference's step.
PrecisionCase make_case(std::string name, std::span<const BodySetup> setups, double phase, double reference_step) {
  PrecisionCase made;
  made.name = std::move(name);
  made.start = build_model(setups, glm::dvec3(0.0));
  made.collision.response = Named{"none"};
  made.omega = omega_of(made.start.model);
  made.duration = phase / made.omega;
  made.reference_steps = static_cast<std::uint64_t>(std::ceil(phase / reference_step));
  return made;
}

PrecisionCase undamped_sphere(int level, double phase) {
  const BodySetup setup = sphere(level);
  PrecisionCase made = make_case("undamped sphere", {&setup, 1}, phase, 0.1);
  made.name += fmt::format(" of {}", made.start.model.vertex_count());
  made.is_contest = true;
  return made;
}

// The damping is strong enough to matter: amplitudes fall by the factor e in 20 rad, which is some three periods.
PrecisionCase damped_sphere(int level, double phase, DampingLaw law, double reference_step) {
  BodySetup setup = sphere(level);
  const double omega = omega_of(setup);
  setup.description.damping = 0.1 * omega * (law == DampingLaw::adaptive ? 0.1 : 1);  // that law goes up to ten times as far
  const bool smooth = law == DampingLaw::constant;
  PrecisionCase made = make_case(smooth ? "constant damping" : "adaptive damping", {&setup, 1}, phase, reference_step);
  made.damping_law = law;
  made.is_contest = smooth;
  return made;
}

// Two ringing spheres approach slowly, and touch after some 12 rad.
PrecisionCase collision(int level, const char* name, double phase, double reference_step) {
  BodySetup setups[] = {sphere(level), sphere(level)};
  const double omega = omega_of(setups[0]);
  for (const int k : {0, 1}) {
    const double side = k == 0 ? -1 : 1;
    setups[k].description.position = {1.4 * side, 0.07 * side, 0};
    setups[k].description.velocity = {-0.02 * omega * side, 0, 0};
  }
  PrecisionCase made = make_case(name, setups, phase, reference_step);
  made.collision.response = Named{"reflect"};
  made.with_peers = false;
  return made;
}

void add_bunny(PrecisionCases& all, const std::filesystem::path& scenes) {
  const std::filesystem::path file = scenes / "bunnies_undamped.toml";
  if (!std::filesystem::exists(file)) {
    all.notes.push_back(fmt::format("undamped bunny: left out, as \"{}\" is not there", file.string()));
    return;
  }
  SceneDescription scene = load_scene(file);
  scene.bodies.resize(1);
  BodyDescription& body = scene.bodies.front();
  body.position = body.velocity = body.rotation = glm::dvec3(0.0);
  body.stretch = squash;
  all.cases.push_back(make_case("undamped bunny", load_bodies(scene), 20, 0.1));
  all.cases.back().is_contest = true;
}

glm::dvec3 mean_of(std::span<const glm::dvec3> values) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double squared(const glm::dvec3& value) { return glm::dot(value, value); }

}  // namespace

TimePlan PrecisionCase::plan_steps(const Integrator& integrator, std::uint64_t steps) const {
  return {.integrator = &integrator,
          .time_step = duration / static_cast<double>(steps),
          .step_bound = largest_step(integrator),
          .steps = steps,
          .damping_law = damping_law};
}

TimePlan PrecisionCase::plan_tolerance(const Integrator& integrator, double tolerance) const {
  const double bound = largest_step(integrator);
  return {.integrator = &integrator,
          .time_step = first_step_fraction * bound,
          .step_bound = bound,
          .damping_law = damping_law,
          .tolerance = tolerance,
          .duration = duration};
}

double PrecisionCase::largest_step(const Integrator& integrator) const {
  double bound = INFINITY;
  for (const ModelBody& body : start.model.bodies)
    bound = std::min({bound, step_bound(integrator, body, damping_law), drag_bound(integrator, body, damping_law)});
  return std::isfinite(bound) ? bound : 1 / omega;
}

PrecisionCases make_precision_cases(const std::filesystem::path& scenes, bool quick) {
  const int level = quick ? 2 : 3;
  PrecisionCases all;
  all.cases.push_back(undamped_sphere(2, quick ? 20 : 40));
  if (!quick) all.cases.push_back(undamped_sphere(3, 40));
  if (!quick) add_bunny(all, scenes);
  all.cases.push_back(damped_sphere(level, quick ? 20 : 40, DampingLaw::constant, 0.1));
  all.cases.push_back(damped_sphere(2, quick ? 20 : 40, DampingLaw::adaptive, quick ? 0.02 : 0.002));
  all.cases.push_back(collision(2, "collision, up to contact", 8, 0.1));
  all.cases.push_back(collision(2, "collision, through contact", quick ? 14 : 20, quick ? 0.01 : 0.002));
  all.cases.back().with_tolerances = false;
  return all;
}

Ending ending_of(const Model& model, const State& state) { return {state.world_positions(model), state.world_velocities(model)}; }

double relative_error(const PrecisionCase& what, const Ending& reference, const Ending& ending) {
  const Model& model = what.start.model;
  const double weight = 1 / (what.omega * what.omega);
  double difference = 0, size = 0;
  for (const ModelBody& body : model.bodies) {
    const auto positions = std::span(reference.positions).subspan(body.first_vertex, body.vertex_count);
    const auto velocities = std::span(reference.velocities).subspan(body.first_vertex, body.vertex_count);
    const glm::dvec3 middle = mean_of(positions), drift = mean_of(velocities);
    for (std::size_t k = 0; k < body.vertex_count; ++k) {
      const std::size_t i = body.first_vertex + k;
      difference += squared(ending.positions[i] - positions[k]) + weight * squared(ending.velocities[i] - velocities[k]);
      size += squared(positions[k] - middle - glm::dvec3(model.rest_positions[i])) + weight * squared(velocities[k] - drift);
    }
  }
  return std::sqrt(difference / size);
}

}  // namespace pliant::bench
