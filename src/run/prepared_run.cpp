#include "run/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>

#include "collision/responses/response.hpp"
#include "core/checksum.hpp"
#include "core/error.hpp"
#include "core/read_text.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "model/load_bodies.hpp"
#include "run/reading_line.hpp"
#include "scene/load_scene.hpp"
#include "simulation/start_check.hpp"
#include "simulation/start_gap.hpp"

namespace pliant {
namespace {

// An option replaces what the scene says. But --set comes from the command line, too, and then neither can replace the other.
void expect_one_of(const std::string& option, const std::string& key, const RunOptions& options) {
  for (const std::string& override : options.overrides)
    if (override.substr(0, override.find_first_of("= ")) == key)
      throw Error(ErrorKind::command_line, option,
                  fmt::format("--set {} is given, too, but only one of them can govern the steps", override), "give one of them");
}

SceneDescription describe_scene(const std::string& text, const RunOptions& options) {
  SceneDescription scene = parse_scene(text, scene_of(options), options.overrides);
  if (options.integrator) scene.simulation.integrator = {*options.integrator, option_origin("--integrator")};
  if (options.time_step) {
    expect_one_of("--time-step", "simulation.tolerance", options);
    scene.simulation.time_step = options.time_step;
    scene.simulation.tolerance.reset();
    scene.simulation.time_step_where = option_origin("--time-step");
  }
  if (options.tolerance) {
    expect_one_of("--tolerance", "simulation.time_step", options);
    scene.simulation.tolerance = options.tolerance;
    scene.simulation.tolerance_where = option_origin("--tolerance");
    scene.simulation.time_step.reset();
  }
  if (options.duration) {
    scene.simulation.duration = *options.duration;
    scene.simulation.duration_where = option_origin("--duration");
  }
  return scene;
}

std::uint64_t checksum_of(const TriangleMesh& mesh) {
  return checksum(std::as_bytes(std::span(mesh.triangles)), checksum(std::as_bytes(std::span(mesh.positions))));
}

// Bodies in rows share their keys.
void warn_of_idle_keys(PreparedRun& run) {
  std::set<std::string> told;
  const auto warn = [&](const Origin& where, std::string_view why) {
    if (told.insert(where.place).second) run.warnings.push_back(fmt::format("{} has no effect {}", where.place, why));
  };
  const std::string with_response = fmt::format("with response = \"{}\"", run.scene.collision.response.value);
  const auto warn_of_surface = [&](const std::vector<Origin>& keys) {
    if (find_response(run.scene.collision.response).reads_surfaces) return;
    for (const Origin& where : keys) warn(where, with_response);
  };
  warn_of_surface(run.scene.collision.surface_keys);
  if (run.scene.simulation.sleep && !find_response(run.scene.collision.response).gives_impulses)
    warn(run.scene.simulation.sleep_where, with_response);
  for (const BodyDescription& body : run.scene.bodies) {
    warn_of_surface(body.surface_keys);
    for (const IdleKey& key : body.idle_keys) warn(key.where, key.why);
  }
}

void warn_of_integrator(PreparedRun& run) {
  const std::string& name = run.scene.simulation.integrator.value;
  if (name != "auto" && name != run.plan.integrator->name)
    run.warnings.push_back(fmt::format("the scene's integrator can't meet a tolerance: {} is taken, as by --integrator auto",
                                       run.plan.integrator->name));
}

void warn_of_step(PreparedRun& run) {
  if (run.plan.steps == 0 || run.plan.time_step <= run.plan.step_bound) return;
  run.warnings.push_back(
      fmt::format("the time step {:.6g} s is {:.3g} times the stability bound of {} here, {:.6g} s: expect growing motion",
                  run.plan.time_step, run.plan.time_step / run.plan.step_bound, run.plan.integrator->name, run.plan.step_bound));
}

// Steps see a path only where they end.
void warn_of_paths(PreparedRun& run) {
  if (run.plan.tolerance) return;
  const double shortest = (1 - 1e-9) * 2 * run.plan.time_step;  // less rounding
  for (const BodyDescription& body : run.scene.bodies)
    for (std::size_t k = 1; k < body.path.size(); ++k) {
      const PathKeyDescription &from = body.path[k - 1], &to = body.path[k];
      if ((from.position == to.position && from.rotation == to.rotation) || to.time - from.time >= shortest) continue;
      run.warnings.push_back(
          fmt::format("steps of {:.3g} s miss part of the path of \"{}\", which has keys {:.3g} s apart; write a "
                      "time_step of at most {:.3g}",
                      run.plan.time_step, body.name, to.time - from.time, (to.time - from.time) / 2));
      break;
    }
}

void warn_of_no_step(PreparedRun& run, const RunOptions& options) {
  if (!run.plan.tolerance && run.plan.steps == 0 && !options.steps && run.scene.simulation.duration > 0)
    run.warnings.push_back(
        fmt::format("no step is made: a step of {:.6g} s is longer than twice the duration of {:.6g} s; shorten the time step",
                    run.plan.time_step, run.scene.simulation.duration));
}

// Impulses are counted in quanta that the heaviest vertex in contact sets.
void warn_of_masses(PreparedRun& run) {
  constexpr double most = 1e9, vanishing = 0x1p46;
  const ModelBody *heaviest = nullptr, *lightest = nullptr;
  for (const ModelBody& body : run.start.model.bodies) {
    if (body.is_rigid()) continue;
    if (heaviest == nullptr || body.vertex_mass > heaviest->vertex_mass) heaviest = &body;
    if (lightest == nullptr || body.vertex_mass < lightest->vertex_mass) lightest = &body;
  }
  if (heaviest != nullptr && heaviest->vertex_mass > most * lightest->vertex_mass)
    run.warnings.push_back(
        fmt::format("a vertex of \"{}\" has {:.3g} times the mass of one of \"{}\": impulses on light ones are rounded{} while "
                    "a heavy one is in contact, too",
                    heaviest->name, heaviest->vertex_mass / lightest->vertex_mass, lightest->name,
                    heaviest->vertex_mass > vanishing * lightest->vertex_mass ? ", to nothing," : ""));
}

void warn_of_rounding(PreparedRun& run) {
  for (std::string& told : told_rounding(run.start.model, run.start.state, run.scene.collision, run.device->precision()))
    run.warnings.push_back(std::move(told));
}

void warn_of_near_starts(PreparedRun& run) {
  for (std::string& told : told_near_starts(run.start.model, run.start.state, run.scene.collision))
    run.warnings.push_back(std::move(told));
}

void warn_of_overlap(PreparedRun& run) {
  if (const std::string overlap = told_overlap(*run.simulation, run.start.model); !overlap.empty())
    run.warnings.push_back(overlap);
}

void check_start(PreparedRun& run) {
  if (run.simulation->collider().response_row().keeps_apart) {
    expect_apart(*run.simulation, run.start.model, run.scene.collision, run.scene.file.string());
    warn_of_near_starts(run);
    warn_of_masses(run);
    warn_of_rounding(run);
  } else {
    warn_of_overlap(run);
  }
}

}  // namespace

std::unique_ptr<PreparedRun> prepare_run(const RunOptions& options, Ranks* ranks) {
  auto prepared = std::make_unique<PreparedRun>();
  PreparedRun& run = *prepared;
  std::error_code gone;
  run.working_folder = options.base.empty() ? std::filesystem::current_path(gone) : options.base;
  run.load_time.start();
  run.scene_text = options.scene_text ? *options.scene_text : read_text(scene_of(options));
  run.scene = describe_scene(run.scene_text, options);
  ReadingLine line(options.quiet ? 0 : bytes_of_meshes(run.scene));
  const std::vector<BodySetup> setups = load_bodies(run.scene, &run.warnings, line.progress(), options.meshes);
  for (const BodySetup& setup : setups) run.mesh_checksums.push_back(checksum_of(setup.mesh));
  run.start = build_model(setups, run.scene.simulation.gravity, run.scene.grounds);
  run.plan = plan_time(run.scene, run.start.model, options.steps);
  run.load_time.stop();
  run.build_time.start();
  run.device = choose_device(ranks != nullptr ? choice_of_rank(options.device, *ranks) : options.device);
  run.device->join(ranks);
  choose_force_sums(run.start.model, run.device->info().kind);
  expect_carried(run.scene, run.plan, run.device->precision());
  run.simulation = std::make_unique<Simulation>(*run.device, run.start.model, run.start.state, run.plan, run.scene.collision);
  warn_of_idle_keys(run);
  warn_of_integrator(run);
  warn_of_step(run);
  warn_of_paths(run);
  warn_of_no_step(run, options);
  if (options.resume.empty()) check_start(run);  // else the run begins elsewhere
  run.build_time.stop();
  return prepared;
}

}  // namespace pliant
