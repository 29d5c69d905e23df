// The suite `precision`: orders, other libraries' agreement, and the tables by made-up rows. Times decide nothing.
#include "bench/precision/precision.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "bench/peers/peers.hpp"
#include "bench/precision/cases.hpp"
#include "bench/precision/cheapest.hpp"
#include "bench/precision/report.hpp"
#include "bench/precision/sweeps.hpp"
#include "mesh/generators.hpp"
#include "simulation/simulation.hpp"
#include "support/has.hpp"
#include "support/json.hpp"
#include "support/paths.hpp"

namespace pliant::bench {
namespace {

PrecisionCase squashed_sphere(DampingLaw law) {
  BodySetup setup;
  setup.mesh = generate_mesh("icosphere:1");
  setup.description.stretch = {0.8, 1.05, 1.1};
  setup.description.damping = law == DampingLaw::adaptive ? 0.4 : 4;
  PrecisionCase what;
  what.start = build_model({&setup, 1}, glm::dvec3(0.0));
  what.damping_law = law;
  what.collision.response = Named{"none"};
  what.omega = std::sqrt(what.start.model.vertex_count() * setup.description.stiffness);
  what.duration = 5 / what.omega;
  what.reference_steps = 500;
  return what;
}

// Where pliant comes to in steps of 1/200 rad.
Ending truth_of(const PrecisionCase& what) {
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, what.start.model, what.start.state, what.plan_steps(find_integrator("vern8"), 1000),
                        what.collision);
  simulation.advance(1000);
  return ending_of(what.start.model, simulation.state());
}

double error_of(const PeerMethod& method, double effort, const PrecisionCase& what, const Ending& truth) {
  PeerSystem system(what.start.model, what.damping_law, what.omega);
  std::vector<double> numbers = system.numbers_of(what.start.state);
  method.integrate(system, numbers, what.duration, effort);
  CHECK(system.evaluations() > 0);
  return relative_error(what, truth, ending_of(what.start.model, system.state_of(numbers, what.start.state)));
}

// Skips the test if there is none of the libraries to compare with. If one is missing, the test says so and goes on.
bool lacks_peers() {
  for (const std::string& missing : missing_peers()) WARN("left out: " << missing);
  if (!peer_methods(false).empty()) return false;
  test::skip("there is no library to compare with");
  return true;
}

TEST_CASE("other libraries come to pliant's end at a tight tolerance, under every damping law") {
  const auto [law, tolerance, bound] =
      GENERATE(table<DampingLaw, double, double>({{DampingLaw::none, 1e-12, 1e-10},
                                                  {DampingLaw::constant, 1e-12, 1e-10},
                                                  {DampingLaw::adaptive, 1e-10, 1e-5}}));  // its kinks cost the order
  if (lacks_peers()) return;
  const PrecisionCase what = squashed_sphere(law);
  const Ending truth = truth_of(what);
  for (const PeerMethod& method : peer_methods(law != DampingLaw::none)) {
    if (!method.adaptive) continue;
    const bool multistep = method.library == "CVODE";  // its tolerance is for a step, and its steps are many and short
    CAPTURE(static_cast<int>(law), method.library, method.name);
    CHECK(error_of(method, tolerance, what, truth) < (multistep ? 10 : 1) * bound);
  }
}

TEST_CASE("other libraries' fixed steps have their methods' order") {
  const std::map<std::string, double> orders{{"dormand_prince_7_4_5", 5},
                                             {"verner_8_5_6", 6},
                                             {"fehlberg_13_7_8", 8},
                                             {"with pliant's vern8", 8},
                                             {"dopri5", 5},
                                             {"fehlberg78", 8},
                                             {"symplectic_rkn_sb3a", 4},
                                             {"adams_bashforth_moulton 8", 8}};
  if (lacks_peers()) return;
  const PrecisionCase what = squashed_sphere(DampingLaw::none);
  const Ending truth = truth_of(what);
  for (const PeerMethod& method : peer_methods(false)) {
    if (method.adaptive) continue;
    const double steps = method.name.starts_with("adams") ? 60 : 8;
    const double coarse = error_of(method, steps, what, truth), fine = error_of(method, 2 * steps, what, truth);
    CAPTURE(method.library, method.name, coarse, fine);
    CHECK(std::log2(coarse / fine) > orders.at(method.name) - 0.5);
  }
}

TEST_CASE("pliant's coefficients of Vern8 take the same steps in every library") {
  if (lacks_peers()) return;
  const PrecisionCase what = squashed_sphere(DampingLaw::none);
  const Ending truth = truth_of(what);
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, what.start.model, what.start.state, what.plan_steps(find_integrator("vern8"), 10),
                        what.collision);
  simulation.advance(10);
  const double own = relative_error(what, truth, ending_of(what.start.model, simulation.state()));
  for (const PeerMethod& method : peer_methods(false)) {
    if (method.name != "with pliant's vern8" || method.adaptive) continue;
    CAPTURE(method.library);
    CHECK(error_of(method, 10, what, truth) / own == Approx(1).epsilon(0.01));
  }
}

// A sweep that ends by its errors and its evaluations, and not by how long they took.
Sweeps untimed_sweeps(const PrecisionCase& what, double most_evaluations) {
  const auto exact = make_cpu_device(1, 64);
  return {what,
          find_reference(*exact, what),
          {.longest_run = INFINITY, .most_evaluations = most_evaluations, .rounds = 1},
          [](std::string_view) { return true; }};
}

std::vector<PrecisionRow> rows_of_steps(const PrecisionCase& what, const Place& place) {
  const auto device = open(place);
  Sweeps sweeps = untimed_sweeps(what, 1200);
  REQUIRE(sweeps.steps(*device, place));
  return sweeps.rows();
}

std::vector<PrecisionRow> rows_of_tolerances(const PrecisionCase& what, const Place& place) {
  const auto device = open(place);
  Sweeps sweeps = untimed_sweeps(what, 500);
  REQUIRE(sweeps.tolerances(*device, place));
  return sweeps.rows();
}

TEST_CASE("errors of a case without damping fall with the methods' orders", "[long]") {
  const PrecisionCases all = make_precision_cases(source_dir() + "/scenes", true);
  const PrecisionCase& what = all.cases.front();
  REQUIRE(what.damping_law == DampingLaw::none);
  const std::vector<PrecisionRow> rows = rows_of_steps(what, {.precision = 64});
  for (const Integrator& integrator : integrators()) {
    // An error of order 12 falls in waves down to rounding. Its slope is taken over all of them, from longer steps on.
    const bool in_waves = integrator.order > 8;
    const double longest = in_waves ? 3.4 : 1.5, least = in_waves ? 1e-13 : 1e-11;
    std::vector<std::pair<double, double>> points;  // step, error
    for (const PrecisionRow& row : rows)
      if (row.method == integrator.name && row.step < longest && row.error > least) points.emplace_back(row.step, row.error);
    CAPTURE(integrator.name);
    REQUIRE(points.size() >= 2);
    const auto [step, error] = points.back();
    const auto [step_before, error_before] = in_waves ? points.front() : points[points.size() - 2];
    CHECK(std::log(error_before / error) / std::log(step_before / step) == Approx(integrator.order).margin(0.4));
  }
  double least_single = 1;
  for (const PrecisionRow& row : rows_of_steps(what, {.precision = 32})) least_single = std::min(least_single, row.error);
  CHECK(least_single > 1e-9);  // fp32's floor
  CHECK(least_single < 1e-5);
}

TEST_CASE("a suite that is ended within its first case keeps the rows that it has") {
  int times = 0;
  const PrecisionResult result = bench_precision({.devices = {.threads = 1}, .scenes = source_dir() + "/scenes", .quick = true},
                                                 [&](double, std::string_view) { return ++times < 10; });
  CHECK(result.interrupted);
  REQUIRE(result.cases.size() == 1);
  CHECK_FALSE(result.cases.front().is_complete);
  CHECK(result.cases.front().reference_error < 1e-12);
  CHECK_FALSE(result.rows.empty());
}

std::set<std::string> methods_of(const std::vector<PrecisionRow>& rows) {
  std::set<std::string> methods;
  for (const PrecisionRow& row : rows) methods.insert(row.method);
  return methods;
}

TEST_CASE("tolerances have rows of the methods that auto takes for them, and of dop853") {
  const auto methods = [](DampingLaw law, int precision) {
    return methods_of(rows_of_tolerances(squashed_sphere(law), {.precision = precision}));
  };
  using Names = std::set<std::string>;
  CHECK(methods(DampingLaw::none, 64) == Names{"dop853", "dprkn8", "dprkn12"});
  CHECK(methods(DampingLaw::none, 32) == Names{"dop853", "dprkn8", "dprkn12"});
  CHECK(methods(DampingLaw::constant, 64) == Names{"dop853", "vern8"});
  CHECK(methods(DampingLaw::constant, 32) == Names{"dop853"});
  CHECK(methods(DampingLaw::adaptive, 64) == Names{"dop853", "verner78_8"});
}

TEST_CASE("an adaptive row's error is near what its tolerance asks") {
  const DampingLaw law = GENERATE(DampingLaw::none, DampingLaw::constant);
  std::size_t tight = 0;
  for (const PrecisionRow& row : rows_of_tolerances(squashed_sphere(law), {.precision = 64})) {
    CAPTURE(row.method, row.tolerance, row.error);
    CHECK(row.adaptive);
    CHECK(row.step == 0);
    CHECK(row.error < 5 * row.tolerance);
    if (row.method != "dop853" || row.tolerance > 2e-5)
      continue;  // others' estimates are pessimistic, and loose tolerances meet the bound
    CHECK(row.error > 1e-3 * row.tolerance);
    ++tight;
  }
  CHECK(tight >= 5);
}

TEST_CASE("no adaptive row asks more than fp32 carries of it, on any device", "[gl]") {
  for (const DeviceKind device : {DeviceKind::cpu, DeviceKind::gpu}) {
    if (device == DeviceKind::gpu && !test::has_gl()) continue;
    double tightest = 1;
    for (const PrecisionRow& row : rows_of_tolerances(squashed_sphere(DampingLaw::none), {.device = device, .precision = 32})) {
      CAPTURE(name_of(device), row.method, row.tolerance);
      CHECK(row.device == device);
      CHECK(row.error < 5 * row.tolerance + 1e-6);
      tightest = std::min(tightest, row.tolerance);
    }
    CHECK(tightest == 1e-7);
  }
}

TEST_CASE("an adaptive row counts the evaluations of all steps, of the rejected ones too") {
  const PrecisionCase what = squashed_sphere(DampingLaw::adaptive);
  const auto device = make_cpu_device(1, 64);
  std::uint64_t rejected = 0;
  for (const PrecisionRow& row : rows_of_tolerances(what, {.precision = 64})) {
    const Integrator& integrator = find_integrator(row.method);
    Simulation simulation(*device, what.start.model, what.start.state, what.plan_tolerance(integrator, row.tolerance),
                          what.collision);
    const StepReport report = simulation.advance_to(what.duration);
    const auto stages = static_cast<std::uint64_t>(nystrom_tableau(integrator, Stages::of_estimates).stages);
    CAPTURE(row.method, row.tolerance);
    CHECK(report.time == what.duration);
    CHECK(row.evaluations == (report.steps + report.adaptive->rejected) * stages);
    rejected += report.adaptive->rejected;
  }
  CHECK(rejected > 0);
}

TEST_CASE("a tolerance that no step meets leaves no end to compare") {
  const PrecisionCase what = squashed_sphere(DampingLaw::none);
  const auto exact = make_cpu_device(1, 64), coarse = make_cpu_device(1, 32);
  const Reference reference = find_reference(*exact, what);
  CHECK(std::isnan(relative_error(what, reference.ending, run_tolerance(*coarse, what, find_integrator("vern8"), 1e-30).ending)));
}

TEST_CASE("tolerances go on where steps cannot be longer, though no error falls") {
  PrecisionCase what = squashed_sphere(DampingLaw::none);
  what.duration /= 2;  // dprkn12's longest steps are good to 1e-6 there
  std::vector<double> tolerances;
  for (const PrecisionRow& row : rows_of_tolerances(what, {.precision = 64}))
    if (row.method == "dprkn12") tolerances.push_back(row.tolerance);
  REQUIRE(tolerances.size() > 6);
  CHECK(tolerances[6] == 1e-8);
}

TEST_CASE("spheres of the first collision case do not touch, and those of the second do") {
  for (const PrecisionCase& what : make_precision_cases("nowhere", true).cases) {
    if (!what.name.starts_with("collision")) continue;
    const auto device = make_cpu_device(1, 64);
    Simulation simulation(*device, what.start.model, what.start.state, what.plan_steps(find_integrator("dop853"), 100),
                          what.collision);
    simulation.advance(100);
    CHECK((simulation.report().contact_steps > 0) == (what.name == "collision, through contact"));
    CHECK(what.with_tolerances == (simulation.report().contact_steps == 0));
  }
}

TEST_CASE("without its scene the bunny is left out, and a note says so") {
  CHECK(make_precision_cases(source_dir() + "/scenes", false).notes.empty());
  CHECK_THAT(make_precision_cases("nowhere", false).notes.at(0), Catch::Contains("bunny") && Catch::Contains("nowhere"));
}

TEST_CASE("an error is relative to the deformation, whatever the body's place") {
  const PrecisionCases all = make_precision_cases("nowhere", true);
  const PrecisionCase& what = all.cases.front();
  Ending here = ending_of(what.start.model, what.start.state), there = here;
  CHECK(relative_error(what, here, here) == 0);
  double size = 0, count = 0;
  for (std::size_t i = 0; i < here.positions.size(); ++i, ++count)
    for (int k = 0; k < 3; ++k)
      size += std::pow(here.positions[i][k] - static_cast<double>(what.start.model.rest_positions[i][k]), 2);
  for (auto& velocity : there.velocities) velocity.x += 1e-3 * what.omega * std::sqrt(size / count);
  CHECK(relative_error(what, here, there) == Approx(1e-3).epsilon(1e-9));
  for (Ending* ending : {&here, &there})
    for (auto& position : ending->positions) position.y += 64;
  CHECK(relative_error(what, here, there) == Approx(1e-3).epsilon(1e-9));
}

TEST_CASE("costs between two errors are interpolated by their logarithms, and beyond them not at all") {
  const ErrorCost points[] = {{1e-2, 1}, {1e-4, 4}, {1e-8, 16}};
  CHECK(cost_to_reach(1e-2, points) == 1.0);
  CHECK(cost_to_reach(1e-3, points).value() == Approx(2));
  CHECK(cost_to_reach(1e-6, points).value() == Approx(8));
  CHECK(cost_to_reach(1e-1, points) == 1.0);
  CHECK_FALSE(cost_to_reach(1e-9, points));
  CHECK_FALSE(cost_to_reach(1e-1, {}));
}

TEST_CASE("an error that rises in between hides no cheaper run") {
  const ErrorCost points[] = {{1e-6, 1}, {1e-3, 2}, {1e-8, 4}};
  CHECK(cost_to_reach(1e-6, points) == 1.0);
}

PrecisionRow row(std::string library, std::string method, int precision, double error, double seconds) {
  return {.case_name = "case",
          .library = std::move(library),
          .method = std::move(method),
          .precision = precision,
          .step = 0.1,
          .evaluations = 10,
          .seconds = seconds,
          .fastest_seconds = seconds,
          .runs = 1,
          .error = error};
}

PrecisionResult made_up() {
  return {
      .cases = {{.name = "case", .vertices = 10, .bodies = 1, .damping_law = "none", .is_contest = true, .is_complete = true}},
      .rows = {row("pliant", "coarse", 64, 1e-2, 1e-3), row("pliant", "coarse", 64, 1e-4, 4e-3),
               row("pliant", "fine", 64, 1e-3, 3e-3), row("pliant", "fine", 64, 1e-7, 5e-3),
               row("pliant", "fine", 32, 1e-5, 1e-3), row("odeint", "other", 64, 1e-3, 9e-3),
               row("odeint", "other", 64, 1e-7, 11e-3)},
      .versions = {{"Boost", "1.74.0"}},
      .notes = {"a note"}};
}

TEST_CASE("the cheapest method is the one that the rows say") {
  const std::vector<CheapestRow> rows = find_cheapest(made_up());
  REQUIRE(rows.size() == 6);  // 1e-2 to 1e-7
  const auto at = [&](double error) {
    for (const CheapestRow& one : rows)
      if (one.error == error) return one;
    FAIL(error);
    return rows.front();
  };
  CHECK(at(1e-2).pliant->contender.method == "coarse");
  CHECK(at(1e-3).pliant->contender.method == "coarse");  // 2 ms
  CHECK(at(1e-4).pliant->contender.method == "fine");
  CHECK(at(1e-4).any->contender.place.precision == 32);
  CHECK(at(1e-6).any->contender.place.precision == 64);
  CHECK(at(1e-3).lead().value() == Approx(4.5));
  CHECK_FALSE(at(1e-3).peers[0]);
}

TEST_CASE("a lost error is named, and a won comparison names none") {
  PrecisionResult result = made_up();
  const auto verdict = [&] { return verdict_of(result); };
  CHECK_THAT(verdict(), Catch::Contains("faster in 5, level in 0, slower in none; 3 of 8 could not be made"));  // 1e-3 to 1e-7
  result.rows.push_back(row("ARKODE", "quick", 64, 1e-6, 2.5e-3));
  CHECK_THAT(verdict(), Catch::Contains("SLOWER in 3: case at 1e-04, case at 1e-05, case at 1e-06"));
  result.rows.push_back(row("CVODE", "exact", 64, 1e-9, 1));  // where pliant has nothing
  CHECK_THAT(verdict(), Catch::Contains("case at 1e-08, case at 1e-09"));
  result.cases.front().is_complete = false;
  CHECK(verdict().empty());
  result = made_up();
  result.rows.resize(5);
  CHECK(verdict().empty());  // nobody to compare with
}

TEST_CASE("leads within 5 % are level, either way") {
  CHECK(standing_of(1.06) == Standing::faster);
  CHECK(standing_of(1.04) == Standing::level);
  CHECK(standing_of(1 / 1.04) == Standing::level);
  CHECK(standing_of(1 / 1.06) == Standing::slower);
}

TEST_CASE("a curve runs through what the best methods of one place reach, and costs rise along it") {
  const std::vector<CostCurve> curves = cost_curves(made_up());
  REQUIRE(curves.size() == 3);  // pliant in fp64 and in fp32, odeint
  const CostCurve& curve = curves.front();
  REQUIRE(curve.errors.size() == 51);  // 1e-2 to 1e-7
  CHECK(curve.errors.front() == Approx(1e-2));
  CHECK(curve.errors.back() == Approx(1e-7));
  CHECK(curve.seconds[10] == Approx(2e-3));  // "coarse" at 1e-3
  CHECK(curve.seconds.back() == Approx(5e-3));
  CHECK(std::ranges::is_sorted(curve.seconds));
  CHECK(curve.evaluations.front() == Approx(10));
}

TEST_CASE("an evaluation's cost is a median over a library's rows on one thread in fp64") {
  const std::vector<EvaluationCost> costs = evaluation_costs(made_up());
  REQUIRE(costs.size() == 2);
  CHECK(costs[0].library == "pliant");
  CHECK(costs[0].seconds == Approx(3.5e-4));
  CHECK(costs[1].seconds == Approx(1e-3));
}

TEST_CASE("the table has every method of one thread in fp64, the winners and the notes") {
  CHECK_THAT(to_table(made_up()), Catch::Contains("coarse") && Catch::Contains("other") && Catch::Contains("coarse 2 ") &&
                                      Catch::Contains("cpu x 1, fp32") && Catch::Contains("a note") &&
                                      Catch::Contains("4.50 faster"));
}

TEST_CASE("adaptive rows of pliant are told apart from its fixed ones, and may win like other libraries'") {
  PrecisionResult result = made_up();
  result.rows.push_back(row("pliant", "fine", 64, 1e-5, 1e-3));
  result.rows.back().adaptive = true;
  result.rows.back().tolerance = 1e-6;
  result.rows.back().step = 0;
  CHECK_THAT(to_table(result), Catch::Contains("fine (adaptive) 1 ") && Catch::Contains("fine 5 "));
  const auto json = test::ReadJson::parse(to_json({}, {}, result));
  const auto& last = json["rows"].back();
  CHECK(last["adaptive"] == true);
  CHECK(last["tolerance"] == 1e-6);
  CHECK(last["step"].is_null());
  std::map<double, std::string> winners;
  for (const auto& one : json["cheapest"]) winners[one["error"].get<double>()] = one["pliant"]["method"].get<std::string>();
  CHECK(winners.at(1e-5) == "fine (adaptive)");
  CHECK(winners.at(1e-6) == "fine");
}

TEST_CASE("times that vary much are told, and steady ones are not") {
  PrecisionResult result = made_up();
  CHECK_THAT(to_table(result), !Catch::Contains("busy"));
  result.rows.front().seconds *= 1.3;
  CHECK_THAT(to_table(result), Catch::Contains("busy"));
}

TEST_CASE("a file has a line for each row") {
  const std::string text = to_json({}, {}, made_up());
  const auto rows = text.find("\"rows\": [\n"), end = text.find("\n  ]", rows);
  REQUIRE(rows != std::string::npos);
  CHECK(std::count(text.begin() + static_cast<std::ptrdiff_t>(rows), text.begin() + static_cast<std::ptrdiff_t>(end), '\n') ==
        static_cast<std::ptrdiff_t>(made_up().rows.size()));
}

TEST_CASE("the file of the suite precision has what a plot needs") {
  PrecisionResult result = made_up();
  result.rows.push_back(row("odeint", "other", 64, 1e-5, 7e-3));
  result.rows.back().adaptive = true;
  result.rows.back().tolerance = 1e-6;
  const auto json = test::ReadJson::parse(to_json({}, {}, result));
  CHECK(json["suite"] == "precision");
  CHECK(json["rows"].size() == result.rows.size());
  for (const auto& one : json["rows"])
    for (const char* key :
         {"case", "library", "method", "adaptive", "device", "precision", "threads", "evaluations", "seconds", "error"}) {
      CAPTURE(key);
      CHECK(one.contains(key));
    }
  CHECK(json["rows"][0]["tolerance"].is_null());
  CHECK(json["rows"].back()["step"].is_null());
  CHECK(json["cases"][0].contains("reference_error"));
  CHECK(json["versions"]["Boost"] == "1.74.0");
  CHECK(json["cheapest"].size() == 6);
  CHECK(json["contest"].size() == 5);
  CHECK(json["curves"].size() == 3);
  CHECK(json["evaluation_costs"][0]["library"] == "pliant");
  CHECK(json["notes"][0] == "a note");
}

}  // namespace
}  // namespace pliant::bench
