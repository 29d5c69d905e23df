// The automatic step stays at least a tenth below the bound of the stiffest body when that is squashed to a half.
#include "simulation/time_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "collision/responses/response.hpp"
#include "core/error.hpp"
#include "dynamics/automatic_integrator.hpp"
#include "dynamics/stability.hpp"
#include "dynamics/stepper.hpp"
#include "physics/pace.glsl"

namespace pliant {
namespace {

double automatic_step(double bound /* for strained bodies */, double frame_rate) {
  const double frame_time = 1 / frame_rate;
  if (!std::isfinite(bound)) return frame_time;
  return frame_time / std::max(1.0, std::ceil(frame_time / (automatic_step_safety * bound) - 1e-9));
}

double first_step(double bound, double frame_rate) { return std::min(first_step_fraction * bound, 1 / frame_rate); }

DampingLaw effective_law(DampingLaw law, const Model& model) {
  const bool damped = std::ranges::any_of(model.bodies, [](const ModelBody& body) { return body.damping > 0; });
  return damped ? law : DampingLaw::none;
}

// A Nystrom tableau holds the damping for one length of steps, and a tolerance varies that length.
bool bears_tolerance(const Integrator& integrator, DampingLaw law) {
  return estimates_error(integrator) && (law == DampingLaw::none || !std::holds_alternative<Nystrom>(integrator.method));
}

// If the scene's method can't meet the tolerance of --tolerance, "auto" replaces it. A method that the command line names stays.
bool gives_way(const Integrator& integrator, const SimulationDescription& simulation, DampingLaw law) {
  return simulation.tolerance && simulation.tolerance_where.from == Origin::From::option &&
         !simulation.integrator.where.is_command_line() && !bears_tolerance(integrator, law);
}

const Integrator& choose_integrator(const SimulationDescription& simulation, DampingLaw law) {
  const auto& [name, where] = simulation.integrator;
  if (name == "auto") {
    if (simulation.tolerance) return automatic_integrator(*simulation.tolerance, law);
    throw Error(where, "\"auto\" chooses by the tolerance, and there is none",
                "give a tolerance, as in tolerance = 1e-6, or name an integrator");
  }
  const Integrator& named = find_integrator(name, where);
  return gives_way(named, simulation, law) ? automatic_integrator(*simulation.tolerance, law) : named;
}

std::string names_that_bear_tolerance(DampingLaw law) {
  std::string names;
  for (const Integrator& integrator : integrators())
    if (bears_tolerance(integrator, law)) names += (names.empty() ? "" : ", ") + std::string(integrator.name);
  return names;
}

void expect_method_estimates(const TimePlan& plan, const Origin& where) {
  if (!plan.tolerance || bears_tolerance(*plan.integrator, plan.damping_law)) return;
  const bool damps = allows_damping(*plan.integrator, plan.damping_law);
  const std::string why = !estimates_error(*plan.integrator) ? "does not estimate its error, which a tolerance needs"
                          : damps ? "meets damping only with steps of one length, and a tolerance varies them"
                                  : fmt::format("can't meet {} damping", name_of(plan.damping_law));
  throw Error(where, fmt::format("{} {}", plan.integrator->name, why),
              fmt::format("take \"auto\" (--integrator auto), or one of {}{}", names_that_bear_tolerance(plan.damping_law),
                          damps ? "; or give a time_step instead of the tolerance" : ""));
}

// Steps of a fixed length are divided only where there is something to touch.
bool divides_steps(const ResponseRow& response, const Model& model) {
  return response.divides_steps && (model.bodies.size() > 1 || model.has_surfaces_to_touch() || !model.grounds.empty());
}

void expect_method_damps(const TimePlan& plan, const Origin& where, bool divides) {
  if (allows_damping(*plan.integrator, plan.damping_law)) return;
  const bool is_nystrom = staged_method(*plan.integrator) != nullptr;
  throw Error(
      where,
      is_nystrom
          ? fmt::format("{} can't meet {} damping, which needs velocities that its stages do not have", plan.integrator->name,
                        name_of(plan.damping_law))
          : fmt::format("{} is for bodies without damping: its steps have kicks back in time, which damping makes unstable",
                        plan.integrator->name),
      fmt::format("set simulation.damping_law = \"{}\" or choose another integrator, such as verlet",
                  is_nystrom && !divides ? "constant" : "none"));
}

void expect_tableaus_fit(const TimePlan& plan, const Model& model, const Origin& where) {
  if (plan.damping_law == DampingLaw::none || !std::holds_alternative<Nystrom>(plan.integrator->method)) return;
  std::set<double> rates;
  for (const ModelBody& body : model.bodies) rates.insert(body.damping * (1 / body.vertex_mass));
  const std::size_t most = Stepper::most_drags(*plan.integrator);
  if (rates.size() <= most) return;
  throw Error(
      where,
      fmt::format("{} keeps the damping in its weights and has room for {} rates (damping over a vertex's mass); the bodies "
                  "have {}",
                  plan.integrator->name, most, rates.size()),
      fmt::format("choose another integrator, such as {}, or give bodies the same rate",
                  rates.size() <= Stepper::most_drags(find_integrator("dprkn8")) ? "dprkn8" : "dop853"));
}

void expect_method_divides(const TimePlan& plan, const Origin& where, bool divides) {
  if (!divides || plan.damping_law == DampingLaw::none || !std::holds_alternative<Nystrom>(plan.integrator->method)) return;
  throw Error(where,
              fmt::format("{} meets damping only with steps of one length, and the response divides them", plan.integrator->name),
              "choose another integrator, such as verlet, set damping_law = \"none\", or write response = \"reflect\"");
}

void expect_drag_resolved(const TimePlan& plan, double bound, const SimulationDescription& simulation) {
  if (plan.time_step <= bound) return;
  const bool is_option = simulation.time_step_where.from == Origin::From::option;
  const Origin& where = is_option ? simulation.time_step_where : simulation.integrator.where;
  throw Error(
      where,
      fmt::format(
          "{} needs steps of at most {:.4g} s to resolve the scene's damping, not {:.4g} s: with longer ones bodies stop short "
          "of where drag lets them go",
          plan.integrator->name, bound, plan.time_step),
      "shorten the time step, or choose verlet, which takes steps of any length");
}

// The body that turns fastest on its path, or null.
const ModelBody* fastest_turning(const Model& model) {
  const ModelBody* fastest = nullptr;
  for (const ModelBody& body : model.bodies)
    if (body.path && (fastest == nullptr || body.path->fastest_spin() > fastest->path->fastest_spin())) fastest = &body;
  return fastest;
}

// Vertices of scripted bodies go straight in a step, so they must not turn far [s].
double turn_bound(const Model& model) {
  constexpr double aimed_turn = 0.25;  // [rad]: then they are off their arcs by 0.8 % of the radius at most
  const ModelBody* const body = fastest_turning(model);
  return body == nullptr ? std::numeric_limits<double>::infinity() : aimed_turn / std::max(body->path->fastest_spin(), 1e-30);
}

void expect_turns_resolved(const TimePlan& plan, const Model& model, const Origin& where) {
  constexpr double most_turn = 1, advised_turn = 0.9;  // [rad]. The first is four times what automatic steps aim at
  const ModelBody* const body = fastest_turning(model);
  if (body == nullptr || body->path->fastest_spin() * plan.time_step <= most_turn) return;
  throw Error(where,
              fmt::format("body \"{}\" turns by {:.3g} rad in a step of {:.4g} s", body->name,
                          body->path->fastest_spin() * plan.time_step, plan.time_step),
              fmt::format("write a time_step of at most {:.2g}", advised_turn / body->path->fastest_spin()));
}

// Returns the shortest bound of all bodies. Bodies with the same stiffest frequency and damping rate have the same bound, so one
// search serves them all: it takes some 20 ms.
template <class Bound>
double shortest_bound(const TimePlan& plan, const Model& model, const Bound& bound) {
  std::set<std::pair<double, double>> known;  // omega^2 and rate
  double shortest = std::numeric_limits<double>::infinity();
  for (const ModelBody& body : model.bodies) {
    const double omega_squared = stiffest_frequency_squared(body);
    if (known.emplace(omega_squared, largest_damping_rate(body, plan.damping_law)).second)
      shortest = std::min(shortest, bound(*plan.integrator, body, plan.damping_law));
  }
  return shortest;
}

// Blames the duration rather than the time step, but an option rather than a line of the file.
Origin origin_of_length(const SceneDescription& scene) {
  const Origin &duration = scene.simulation.duration_where, &step = scene.simulation.time_step_where;
  const Origin& where = duration.from >= step.from ? duration : step;
  return where.from == Origin::From::nowhere ? Origin{Origin::From::file, scene.file.string()} : where;
}

// The body with the shortest bound on steps.
const ModelBody& most_demanding(const TimePlan& plan, const Model& model) {
  return *std::ranges::min_element(model.bodies, {}, [&](const ModelBody& body) {
    return std::min(step_bound(*plan.integrator, body, plan.damping_law), drag_bound(*plan.integrator, body, plan.damping_law));
  });
}

// Expects a plan with its bound. With a tolerance there are at least so many steps.
std::uint64_t count_steps(const SceneDescription& scene, const Model& model, const TimePlan& plan, double time_step) {
  const double count = std::round(scene.simulation.duration / time_step);
  if (count <= physics::most_steps()) return static_cast<std::uint64_t>(count);
  if (!scene.simulation.time_step && turn_bound(model) < plan.step_bound)
    throw Error(origin_of_length(scene),
                fmt::format("the run takes more than 3e8 steps, because body \"{}\" turns at up to {:.3g} rad/s on its path",
                            fastest_turning(model)->name, fastest_turning(model)->path->fastest_spin()),
                "let it turn more slowly, or shorten the duration");
  if (!scene.simulation.time_step && time_step < 1 / plan.frame_rate)
    throw Error(origin_of_length(scene),
                fmt::format("the run takes more than 3e8 steps, because body \"{}\" needs them as short as {:.3g} s",
                            most_demanding(plan, model).name, time_step),
                "lower its stiffness or damping, raise its mass, or shorten the duration");
  throw Error(origin_of_length(scene), "the run takes more than 3e8 steps",
              "shorten the duration, or lengthen the time step (with a tolerance: lower output.frame_rate)");
}

}  // namespace

std::uint64_t TimePlan::step_of_frame(std::uint64_t frame) const {
  constexpr double rounding = 1e-12;  // relative: a frame takes a step that misses it only by the quotient's rounding
  const double step = static_cast<double>(frame) / (frame_rate * time_step);
  return static_cast<std::uint64_t>(std::min(std::ceil(step * (1 - rounding)), 1e18));
}

std::uint64_t TimePlan::next_frame_step(std::uint64_t step) const {
  const double frames_per_step = frame_rate * time_step;
  if (frames_per_step >= 1) return step + 1;
  auto frame = static_cast<std::uint64_t>(static_cast<double>(step) * frames_per_step);  // one or two too few
  while (step_of_frame(frame) <= step) ++frame;
  return step_of_frame(frame);
}

std::optional<double> TimePlan::time_of_frame(std::uint64_t frame) const {
  constexpr double rounding = 1e-12;  // relative, as above
  const double time = static_cast<double>(frame) / frame_rate;
  if (time > duration * (1 + rounding)) return std::nullopt;
  return std::min(time, duration);
}

DampingLaw damping_law_of(const SceneDescription& scene) {
  const bool falls = scene.simulation.gravity != glm::dvec3(0.0);
  return scene.simulation.damping_law.value_or(falls ? find_response(scene.collision.response).law_with_gravity
                                                     : DampingLaw::adaptive);
}

TimePlan plan_time(const SceneDescription& scene, const Model& model, std::optional<std::uint64_t> steps) {
  const SimulationDescription& simulation = scene.simulation;
  if (steps && simulation.tolerance)
    throw Error(ErrorKind::command_line, "--steps", "steps have no fixed length if a tolerance governs them",
                "give --duration instead");
  const ResponseRow& response = response_of(scene);
  TimePlan plan{.frame_rate = scene.output.frame_rate,
                .damping_law = effective_law(damping_law_of(scene), model),
                .tolerance = simulation.tolerance,
                .duration = simulation.duration,
                .sleep = simulation.sleep};
  plan.integrator = &choose_integrator(simulation, plan.damping_law);
  expect_method_estimates(plan, simulation.integrator.where);  // first, because its remedies also help with damping
  const bool divides = divides_steps(response, model);
  expect_method_damps(plan, simulation.integrator.where, divides);
  expect_tableaus_fit(plan, model, simulation.integrator.where);
  expect_method_divides(plan, simulation.integrator.where, divides);
  plan.step_bound = shortest_bound(plan, model, [](auto&... what) { return step_bound(what...); });
  if (plan.tolerance) plan.step_bound = std::min(plan.step_bound, turn_bound(model));
  const double longest_drag = shortest_bound(plan, model, [](auto&... what) { return drag_bound(what...); });
  if (plan.tolerance) {
    plan.time_step = first_step(plan.step_bound, plan.frame_rate);
    count_steps(scene, model, plan, std::min(plan.step_bound, 1 / plan.frame_rate));
  } else {
    plan.time_step = simulation.time_step.value_or(automatic_step(
        std::min({plan.integrator->strained_bound * plan.step_bound, longest_drag, turn_bound(model)}), plan.frame_rate));
    expect_drag_resolved(plan, longest_drag, simulation);
    expect_turns_resolved(plan, model, simulation.time_step_where);
    plan.steps = steps ? *steps : count_steps(scene, model, plan, plan.time_step);
  }
  return plan;
}

double smallest_tolerance(const Integrator& integrator, int precision) { return precision == 32 ? integrator.fp32_tolerance : 0; }

void expect_carried(const SceneDescription& scene, const TimePlan& plan, int precision) {
  if (!plan.tolerance || *plan.tolerance >= smallest_tolerance(*plan.integrator, precision)) return;
  const Origin& where = scene.simulation.tolerance_where;
  throw Error(
      where, fmt::format("a tolerance of {} is too small for forces in fp32 with {}", *plan.tolerance, plan.integrator->name),
      fmt::format("write {} or more, or run with --device cpu --precision 64", smallest_tolerance(*plan.integrator, precision)));
}

}  // namespace pliant
