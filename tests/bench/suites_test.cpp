// The suites as they run with --quick: what they cover, not how fast it is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "bench/report.hpp"
#include "bench/step_cases.hpp"
#include "gl/context.hpp"
#include "simulation/simulation.hpp"
#include "support/expect_error.hpp"
#include "support/paths.hpp"
#include "support/scratch.hpp"

namespace pliant::bench {
namespace {

// What Progress was told.
struct Told {
  std::vector<double> done;
  std::vector<std::string> next;
  Progress progress() {
    return [this](double part, std::string_view what) {
      done.push_back(part);
      next.emplace_back(what);
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
  const std::vector<ForcesRow> rows = bench_forces(options, told.progress());
  std::set<std::pair<int, unsigned>> covered;
  const std::string table = to_table(rows);
  for (const ForcesRow& row : rows) {
    CAPTURE(row.device, row.variant, row.vertices);
    covered.emplace(row.precision, row.threads);
    for (const double rate : {row.pairs_per_second, row.bound_pairs_per_second, row.ratio_to_bound}) {
      CHECK(std::isfinite(rate));
      CHECK(rate > 0);
    }
    CHECK(mentions(table, {row.device, row.variant, std::to_string(row.vertices)}));
    CHECK(std::ranges::any_of(told.next, [&](const std::string& next) {
      return next.find(row.variant) != std::string::npos && next.find(std::to_string(row.vertices)) != std::string::npos;
    }));
  }
  CHECK(covered == precisions_and_threads);
  CHECK(std::ranges::is_sorted(told.done));
  CHECK(told.done.back() == 1);
}

TEST_CASE("forces are measured on the CPU with one thread and all, in both precisions") {
  check_forces({.devices = {.threads = 2}, .quick = true}, {{32, 1}, {32, 2}, {64, 1}, {64, 2}});
}

TEST_CASE("forces are measured on the GPU", "[gl]") {
  if (gl::list_adapters().empty()) return;
  check_forces({.devices = {.cpu = false, .gpu = true}, .quick = true}, {{32, 1}});
}

TEST_CASE("forces in all variants have a row for each and every size") {
  const std::vector<ForcesRow> rows =
      bench_forces({.devices = {.threads = 1}, .quick = true, .all_variants = true}, [](double, std::string_view) {});
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

TEST_CASE("bodies of each family have touched when the measured steps begin") {
  StepCases all = load_step_cases(source_dir() + "/scenes", false);
  const auto device = make_cpu_device(0, 32);
  for (const StepCase& what : all.cases) {
    if (what.family.empty() || what.start.model.vertex_count() > 4000) continue;
    Simulation simulation(*device, what.start.model, what.start.state, what.plan, what.collision);
    simulation.advance(what.steps_before);
    CAPTURE(what.name);
    CHECK(simulation.report().contact_steps > 0);
  }
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
    CHECK(row.runs == 1);
    CHECK(row.contact_steps <= row.steps);
    CHECK(mentions(table, {row.scene, row.device, std::to_string(row.vertices)}));
    CHECK(std::ranges::any_of(told.next, [&](const std::string& next) { return next.find(row.scene) != std::string::npos; }));
  }
  CHECK(threads == std::set<unsigned>{1, 2});
  CHECK(result.rows.size() == 2 * 3);                           // the scene, and two sizes of its family
  CHECK_THAT(table, Catch::Contains("bunnies_undamped.toml"));  // is left out
  CHECK(told.done.back() == 1);
  CHECK(result.crossovers.empty());  // without a GPU
}

TEST_CASE("a scene without a step is left out, and a note says so") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "still.toml") << "[simulation]\ntime_step = 0.01\nduration = 0\n[[body]]\nmesh = \"icosphere:1\"\n";
  const StepCases all = load_step_cases(folder.path, false);
  CHECK(all.cases.empty());
  CHECK_THAT(all.notes.back(), Catch::Contains("still") && Catch::Contains("no steps"));
}

TEST_CASE("a folder without scenes is a mistake on the command line") {
  const test::ScratchFolder folder;
  const Error error = error_of([&] { return load_step_cases(folder.path, true); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"--scenes", "no scenes"});
}

}  // namespace
}  // namespace pliant::bench
