#include "bench/common/step_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "mesh/subdivide.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"

namespace pliant::bench {
namespace {

// Two bodies of a scene, moved together along x until they overlap by a tenth, so that they touch in every step at any density.
// They approach by about a tenth of an edge a step.
struct Family {
  const char* name;
  const char* scene;
  std::string_view mesh;  // beginning of the bodies' mesh names
  double half_distance;   // of the bodies' positions along x [m]
  double time_step;       // at base_level [s]
  int base_level;
  int first_level, last_level, last_quick_level;
};

constexpr Family families[] = {
    {"two icospheres", "two_spheres.toml", "icosphere:", 0.9, 0.0005, 3, 1, 6, 2},
    {"two bunnies, split", "bunnies_undamped.toml", "", 0.9, 0.002, 0, 0, 2, -1},
};

// Returns why the scene does not serve the family, or an empty text if it does.
std::string misfit(const Family& family, const SceneDescription& scene) {
  if (scene.bodies.size() != 2) return fmt::format("\"{}\" has not two bodies", family.scene);
  const auto fits = [&](const BodyDescription& body) { return body.mesh.starts_with(family.mesh); };
  if (scene.simulation.tolerance) return fmt::format("\"{}\" has a tolerance", family.scene);
  if (!std::ranges::all_of(scene.bodies, fits)) return fmt::format("the bodies of \"{}\" are no icospheres", family.scene);
  return {};
}

SceneDescription scene_at(const Family& family, SceneDescription scene, int level) {
  for (BodyDescription& body : scene.bodies) {
    body.position.x = std::copysign(family.half_distance, body.position.x);
    if (body.mesh.starts_with("icosphere:")) body.mesh = fmt::format("icosphere:{}", level);
  }
  scene.collision.response.value = "reflect";  // bodies that overlap are its to answer
  scene.simulation.time_step = family.time_step * std::exp2(family.base_level - level);
  return scene;
}

StepCase make_case(const SceneDescription& scene, std::span<const BodySetup> setups) {
  StepCase made;
  made.start = build_model(setups, scene.simulation.gravity, scene.grounds);
  made.plan = plan_time(scene, made.start.model);
  made.collision = scene.collision;
  return made;
}

StepCase case_of(const Family& family, const SceneDescription& as_it_is, int level) {
  const SceneDescription scene = scene_at(family, as_it_is, level);
  std::vector<BodySetup> setups = load_bodies(scene);
  for (BodySetup& setup : setups)
    if (!setup.description.mesh.starts_with("icosphere:")) setup.mesh = subdivide(setup.mesh, static_cast<unsigned>(level));
  StepCase made = make_case(scene, setups);
  made.name = fmt::format("{}:{}", family.name, level);
  made.family = family.name;
  made.steps_before = 3;
  const bool long_steps = made.start.model.vertex_count() > 10000;
  made.steps = long_steps ? 4 : 64;
  return made;
}

StepCase case_of(const SceneDescription& scene) {
  StepCase made = make_case(scene, load_bodies(scene));
  made.name = scene.file.stem().string();
  made.output = scene.output;
  made.steps = made.plan.steps;
  return made;
}

std::set<std::filesystem::path> scene_files(const std::filesystem::path& folder) {
  std::error_code failure;
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  if (files.empty())
    throw Error(ErrorKind::command_line, "--scenes", fmt::format("no scenes in folder \"{}\"", folder.string()),
                "name the folder of scenes, or run where there is a folder \"scenes\"");
  return files;
}

// Adds the scene as it is, or a note why not.
void add_scene(StepCases& all, const std::filesystem::path& file) {
  const auto leave_out = [&](const std::string& reason) {
    all.notes.push_back(fmt::format("{}: left out, as {}", file.stem().string(), reason));
  };
  const SceneDescription scene = load_scene(file);
  if (scene.simulation.tolerance) return leave_out("its tolerance gives steps no fixed length");
  StepCase made = case_of(scene);
  if (made.steps == 0) return leave_out("it has no steps");
  all.cases.push_back(std::move(made));
}

// Adds the family's cases, or a note why there are none.
void add_family(StepCases& all, const Family& family, const std::filesystem::path& folder, bool quick) {
  const auto leave_out = [&](const std::string& reason) {
    all.notes.push_back(fmt::format("{}: left out, as {}", family.name, reason));
  };
  const int last = quick ? family.last_quick_level : family.last_level;
  if (last < family.first_level) return leave_out("it is too large for a quick measurement");
  if (!std::filesystem::exists(folder / family.scene)) return leave_out(fmt::format("\"{}\" is not in the folder", family.scene));
  const SceneDescription scene = load_scene(folder / family.scene);
  if (const std::string reason = misfit(family, scene); !reason.empty()) return leave_out(reason);
  for (int level = family.first_level; level <= last; ++level) all.cases.push_back(case_of(family, scene, level));
}

}  // namespace

void choose_force_sums(StepCases& all, DeviceKind device) {
  for (StepCase& what : all.cases) pliant::choose_force_sums(what.start.model, device);
}

std::uint32_t clustered_bodies(const Model& model) {
  return static_cast<std::uint32_t>(std::ranges::count_if(model.bodies, &ModelBody::is_clustered));
}

void expect_scenes(const std::filesystem::path& folder) { static_cast<void>(scene_files(folder)); }

StepCases load_step_cases(const std::filesystem::path& folder, bool quick) {
  const std::set<std::filesystem::path> files = scene_files(folder);
  StepCases all;
  for (const Family& family : families) add_family(all, family, folder, quick);
  for (const std::filesystem::path& file : files) add_scene(all, file);
  return all;
}

}  // namespace pliant::bench
