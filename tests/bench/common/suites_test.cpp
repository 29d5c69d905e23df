// The suites as they run with --quick: what they cover, not how fast it is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "bench/common/step_cases.hpp"
#include "bench/draw/report.hpp"
#include "bench/forces/report.hpp"
#include "bench/steps/report.hpp"
#include "simulation/simulation.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/scratch.hpp"

namespace pliant::bench {
namespace {

// Collects what Progress was told.
struct Told {
  std::vector<double> done;
  std::vector<std::string> next;
  int most = 1'000'000;  // after so many it says to end
  Progress progress() {
    return [this](double part, std::string_view what) {
      done.push_back(part);
      next.emplace_back(what);
      return static_cast<int>(next.size()) <= most;
    };
  }
};

bool mentions(const std::string& table, std::initializer_list<std::string> words) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    if (std::ranges::all_of(words, [&](const std::string& word) { return line.find(word) != std::string::npos; })) return true;
  return false;
}

void check_forces(const ForcesOptions& options, const std::set<std::pair<int, unsigned>>& precisions_and_threads) {
  Told told;
  const ForcesResult result = bench_forces(options, told.progress());
  const std::vector<ForcesRow>& rows = result.rows;
  std::set<std::pair<int, unsigned>> covered;
  const std::string table = to_table(result);
  for (const ForcesRow& row : rows) {
    CAPTURE(name_of(row.device), row.variant, row.vertices);
    covered.emplace(row.precision, row.threads);
    CHECK(row.fastest_seconds_per_evaluation <= row.seconds_per_evaluation);
    for (const double rate : {row.pairs_per_second, row.bound_pairs_per_second, row.ratio_to_bound}) {
      CHECK(std::isfinite(rate));
      CHECK(rate > 0);
    }
    CHECK(mentions(table, {std::string(name_of(row.device)), row.variant, std::to_string(row.vertices)}));
    CHECK(std::ranges::any_of(told.next, [&](const std::string& next) {
      return next.find(row.variant) != std::string::npos && next.find(std::to_string(row.vertices)) != std::string::npos;
    }));
  }
  CHECK(covered == precisions_and_threads);
  CHECK(std::ranges::is_sorted(told.done));
  CHECK(told.done.back() == 1);
}

TEST_CASE("a scene whose steps have no fixed length is left out, and a note says so") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "free.toml") << "[simulation]\ntolerance = 1e-6\n[[body]]\nmesh = \"icosphere:0\"\n";
  const StepCases all = load_step_cases(folder.path, true);
  CHECK(all.cases.empty());
  CHECK_THAT(all.notes.back(), Catch::Contains("free") && Catch::Contains("tolerance"));
}

TEST_CASE("forces are measured on the CPU with one thread and all, in both precisions") {
  check_forces({.devices = {.threads = 2}, .quick = true}, {{32, 1}, {32, 2}, {64, 1}, {64, 2}});
}

TEST_CASE("forces are measured on the GPU", "[gl]") {
  if (test::lacks_gl()) return;
  check_forces({.devices = {.cpu = false, .gpu = true}, .quick = true}, {{32, 1}});
}

TEST_CASE("forces in all variants have a row for each and every size") {
  const std::vector<ForcesRow> rows =
      bench_forces({.devices = {.threads = 1}, .quick = true, .all_variants = true}, [](double, std::string_view) {
        return true;
      }).rows;
  const auto device = make_cpu_device(1, 32);
  for (const ForceVariant& variant : device->force_variants())
    CHECK(std::ranges::count(rows, variant.name, &ForcesRow::variant) == 4);  // two sizes, two precisions
}

TEST_CASE("the suite of steps has every shipped scene, and two families that touch early on") {
  const StepCases all = load_step_cases(source_dir() + "/scenes", false);
  CHECK(all.notes.empty());
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/scenes")) {
    const std::string name = entry.path().stem().string();
    scenes += std::ranges::any_of(all.cases, [&](const StepCase& c) { return c.name == name && c.steps == c.plan.steps; });
  }
  CHECK(scenes >= 7);
  std::map<std::string, std::uint32_t> vertices;
  for (const StepCase& what : all.cases) {
    if (what.family.empty()) continue;
    CHECK(what.start.model.vertex_count() > vertices[what.family]);  // ever denser
    vertices[what.family] = what.start.model.vertex_count();
    CHECK(what.plan.time_step < what.plan.step_bound);
  }
  CHECK(vertices.size() == 2);
  CHECK(vertices["two icospheres"] == 2 * 40962);
}

TEST_CASE("bodies of each family touch in every measured step") {
  StepCases all = load_step_cases(source_dir() + "/scenes", false);
  const auto device = make_cpu_device(0, 32);
  for (const StepCase& what : all.cases) {
    if (what.family.empty() || what.start.model.vertex_count() > 4000) continue;
    Simulation simulation(*device, what.start.model, what.start.state, what.plan, what.collision);
    simulation.advance(what.steps_before + what.steps);
    CAPTURE(what.name);
    CHECK(simulation.report().contact_steps == what.steps_before + what.steps);
  }
}

TEST_CASE("a quick measurement makes the very steps of the full one, and none of large families") {
  const StepCases full = load_step_cases(source_dir() + "/scenes", false),
                  quick = load_step_cases(source_dir() + "/scenes", true);
  CHECK(quick.cases.size() > 9);
  for (const StepCase& what : quick.cases) {
    CAPTURE(what.name);
    const auto same = std::ranges::find(full.cases, what.name, &StepCase::name);
    REQUIRE(same != full.cases.end());
    CHECK((what.steps == same->steps && what.steps_before == same->steps_before));
    CHECK(what.plan.time_step == same->plan.time_step);
    CHECK(what.start.state.motion == same->start.state.motion);
    CHECK((what.family.empty() || what.start.model.vertex_count() < 1000));
  }
  CHECK_THAT(quick.notes.at(0), Catch::Contains("two bunnies") && Catch::Contains("quick"));
}

TEST_CASE("a quick measurement leaves out what takes long, and a note says so") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "long.toml") << "[simulation]\ntime_step = 1e-9\nduration = 0.1\n"
                                              "[[body]]\nmesh = \"icosphere:2\"\nstretch = [1.1, 1, 1]\n";
  std::ofstream(folder.path / "short.toml")
      << "[simulation]\ntime_step = 0.001\nduration = 0.003\n[[body]]\nmesh = \"icosphere:0\"\n";
  const StepsResult result = bench_steps({.devices = {.threads = 1}, .scenes = folder.path, .quick = true},
                                         [](double, std::string_view) { return true; });
  REQUIRE(result.rows.size() == 1);
  CHECK((result.rows[0].scene == "short" && result.rows[0].steps == 3));
  CHECK_THAT(result.notes.back(), Catch::Contains("long on cpu") && Catch::Contains("left out of a quick measurement"));
}

// 10,000 bodies without springs to speak of: what a step costs can't be told from these. All steps would take hours.
TEST_CASE("the whole measurement leaves out what would take over a minute, whatever its steps spend that on") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "many.toml") << "[simulation]\ntime_step = 1e-7\nduration = 0.1\n[[body]]\nmesh = \"icosphere:0\"\n"
                                              "count = [100, 1, 100]\nspacing = [3, 0, 3]\nvelocity = [0, 1, 0]\n";
  const StepsResult result =
      bench_steps({.devices = {.threads = 1}, .scenes = folder.path}, [](double, std::string_view) { return true; });
  CHECK(result.rows.empty());
  CHECK_THAT(result.notes.back(), Catch::Contains("many on cpu") && Catch::Contains("left out, as it would take about"));
}

TEST_CASE("a suite told to end has the rows that were finished") {
  Told told;
  told.most = 2;
  const ForcesResult forces = bench_forces({.devices = {.threads = 1}, .quick = true}, told.progress());
  CHECK(forces.interrupted);
  CHECK(forces.rows.size() == 2);
  for (const ForcesRow& row : forces.rows) CHECK(row.bound_pairs_per_second > 0);
  const test::ScratchFolder folder;
  std::filesystem::copy(source_dir() + "/scenes/two_spheres.toml", folder.path);
  told = {};
  told.most = 1;
  const StepsResult steps = bench_steps({.devices = {.threads = 1}, .scenes = folder.path, .quick = true}, told.progress());
  CHECK(steps.interrupted);
  CHECK(steps.rows.size() == 1);
}

TEST_CASE("a ratio above 1 is explained, and only then") {
  ForcesResult result;
  result.notes = {"a note"};
  result.rows.resize(1);
  result.rows.front().ratio_to_bound = 0.9;
  CHECK_THAT(to_table(result), Catch::Contains("a note") && !Catch::Contains("busy"));
  result.rows.front().ratio_to_bound = 1.1;
  CHECK_THAT(to_table(result), Catch::Contains("a note") && Catch::Contains("busy"));
}

TEST_CASE("steps are measured on one thread and all, and every row is told") {
  const test::ScratchFolder folder;
  std::filesystem::copy(source_dir() + "/scenes/two_spheres.toml", folder.path);
  Told told;
  const StepsOptions options{.devices = {.threads = 2}, .scenes = folder.path, .quick = true};
  const StepsResult result = bench_steps(options, told.progress());
  const std::string table = to_table(result);
  std::set<unsigned> threads;
  for (const StepsRow& row : result.rows) {
    CAPTURE(row.scene);
    threads.insert(row.threads);
    CHECK(std::isfinite(row.steps_per_second));
    CHECK((row.runs >= 1 && row.runs <= 5));
    CHECK(row.contact_steps <= row.steps);
    CHECK(mentions(table, {row.scene, std::string(name_of(row.device)), std::to_string(row.vertices)}));
    CHECK(std::ranges::any_of(told.next, [&](const std::string& next) { return next.find(row.scene) != std::string::npos; }));
  }
  CHECK(threads == std::set<unsigned>{1, 2});
  // The scene, and two sizes of its family. Two bunnies have no scene here. Whether the scene is short depends on the processor.
  CHECK(result.rows.size() + result.notes.size() == 2 * 3 + 1);
  CHECK_THAT(table, Catch::Contains("two bunnies, split: left out"));
  CHECK(told.done.back() == 1);
  CHECK(result.crossovers.empty());
}

TEST_CASE("drawing is timed for every scene, frame and pass", "[gl]") {
  if (test::lacks_gl()) return;
  const test::ScratchFolder folder;
  std::filesystem::copy(source_dir() + "/scenes/two_spheres.toml", folder.path);
  Told told;
  const DrawOptions options{.gpu_index = 0, .scenes = folder.path, .size = {64, 48}, .quick = true};
  const DrawResult result = bench_draw(options, told.progress());
  const std::string table = to_table(result), json = to_json({}, options, result);
  REQUIRE(result.rows.size() == 3);  // the scene, and two sizes of its family
  for (const DrawRow& row : result.rows) {
    CAPTURE(row.scene);
    CHECK((row.width == 64 && row.height == 48 && row.bodies == 2));
    CHECK(row.milliseconds_per_frame >= row.fastest_milliseconds_per_frame);
    CHECK(row.fastest_milliseconds_per_frame > 0);
    CHECK(row.milliseconds.size() >= 5);
    CHECK_FALSE(row.steps_lost);  // a quick measurement can't tell
    for (const auto& [pass, milliseconds] : row.milliseconds) {
      CHECK(milliseconds >= 0);
      CHECK_THAT(table, Catch::Contains(pass));
      CHECK_THAT(json, Catch::Contains("\"" + pass + "_milliseconds\": ") || Catch::Contains("\"" + pass + "_milliseconds\":"));
    }
    CHECK(mentions(table, {row.scene, std::to_string(row.triangles), "64 x 48"}));
  }
  CHECK(told.done.back() == 1);
}

TEST_CASE("a millisecond a picture costs 6 % of all steps, and the table says so") {
  CHECK(share_lost(0.011, 0.010) == Approx(0.06));
  DrawResult result;
  result.rows.resize(2);
  result.rows[0].steps_lost = 0.0625;
  CHECK_THAT(to_table(result), Catch::Contains("steps lost") && Catch::Contains(" 6.2 %") && Catch::Contains("  -\n"));
  const std::string json = to_json({}, DrawOptions{}, result);
  CHECK_THAT(json, Catch::Contains("\"steps_lost\":0.0625") && Catch::Contains("\"steps_lost\":null"));
}

TEST_CASE("a scene without a step is left out, and a note says so") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "still.toml") << "[simulation]\ntime_step = 0.01\nduration = 0\n[[body]]\nmesh = \"icosphere:1\"\n";
  const StepCases all = load_step_cases(folder.path, false);
  CHECK(all.cases.empty());
  CHECK_THAT(all.notes.back(), Catch::Contains("still") && Catch::Contains("no steps"));
}

TEST_CASE("a scene serves as a family only with two bodies of its meshes") {
  const auto notes_with = [](const std::string& bodies) {
    const test::ScratchFolder folder;
    std::ofstream(folder.path / "two_spheres.toml") << "[simulation]\ntime_step = 0.01\nduration = 0.05\n" << bodies;
    const StepCases all = load_step_cases(folder.path, true);
    CHECK(all.cases.size() == 1);  // the scene as it is
    return all.notes.front();
  };
  const std::string sphere = "[[body]]\nmesh = \"icosphere:1\"\nposition = [-1, 0, 0]\n";
  const std::string teapot = "[[body]]\nmesh = \"" + source_dir() + "/meshes/teapot.obj\"\nposition = [9, 0, 0]\n";
  CHECK_THAT(notes_with(sphere), Catch::Contains("two icospheres: left out") && Catch::Contains("two bodies"));
  CHECK_THAT(notes_with(sphere + teapot), Catch::Contains("two icospheres: left out") && Catch::Contains("no icospheres"));
}

TEST_CASE("a folder without scenes is a mistake on the command line") {
  const test::ScratchFolder folder;
  const Error error = error_of([&] { return load_step_cases(folder.path, true); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"--scenes", "no scenes"});
}

}  // namespace
}  // namespace pliant::bench
