// The suite `collision`: every engine finds the same pairs, and every row is told. How fast they are is no matter here.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "bench/collision/report.hpp"
#include "bench/collision/tree_peers.hpp"
#include "support/has.hpp"
#include "support/json.hpp"

namespace pliant::bench {
namespace {

CollisionResult quick_result(const Selection& devices) {
  std::vector<double> done;
  const CollisionResult result = bench_collision({.devices = devices, .quick = true}, [&](double part, std::string_view) {
    done.push_back(part);
    return true;
  });
  CHECK(std::ranges::is_sorted(done));
  CHECK(done.back() == 1);
  const std::string table = to_table(result);
  for (const CollisionRow& row : result.rows) {
    CAPTURE(row.engine, row.overlap, row.triangles);
    CHECK(row.agrees);
    CHECK((row.pairs == 0) == (row.overlap == "apart"));
    CHECK((std::isfinite(row.refit_and_query_seconds()) && row.query_seconds > 0));
    CHECK_THAT(table, Catch::Contains(row.engine) && Catch::Contains(std::to_string(row.triangles)));
  }
  for (const ContactStepRow& row : result.contact_steps) {
    CAPTURE(row.triangles);
    CHECK(row.pressing_contacts > row.triangles / 100);
    for (const auto& [group, seconds] : row.seconds) CHECK((seconds > 0 && seconds < row.step_seconds));
  }
  return result;
}

std::size_t rows_of(const std::vector<CollisionRow>& rows, const std::string& engine) {
  return static_cast<std::size_t>(std::ranges::count(rows, engine, &CollisionRow::engine));
}

TEST_CASE("pliant and other libraries find the same pairs of triangles, on one thread and all") {
  const CollisionResult result = quick_result({.threads = 2});
  const std::vector<CollisionRow>& rows = result.rows;
  constexpr std::size_t cases = 2 * 3;                // sizes and overlaps
  CHECK(rows_of(rows, "pliant") == 2 * (cases + 1));  // and many spheres
  for (const char* engine : {"pliant, centre", "pliant, surface area"}) CHECK(rows_of(rows, engine) == 2 * cases);
  CHECK(rows_of(rows, "brute force") == 2 * cases / 2);  // small ones alone
  for (const auto& libraries : {embree_trees(), fcl_trees(), bullet_trees()})
    for (const TreeLibrary& library : libraries) CHECK(rows_of(rows, library.name) == cases);
  std::set<std::uint64_t> pairs;
  for (const CollisionRow& row : rows) pairs.insert(row.pairs);
  CHECK(pairs.size() == 1 + 2 * 2 + 1);         // 0 apart, other numbers for each size and overlap, and that of many spheres
  CHECK(result.contact_steps.size() == 2 * 2);  // sizes, and threads
}

TEST_CASE("the GPU finds the same pairs of triangles as other libraries", "[gl]") {
  if (test::lacks_gl()) return;
  const CollisionResult result = quick_result({.cpu = false, .gpu = true});
  CHECK(rows_of(result.rows, "pliant") == 7);
  CHECK(result.contact_steps.size() == 2);
}

TEST_CASE("the file of a measurement of collisions has every row, and null where there is no tree or no thread") {
  CollisionRow tree, brute_force;
  tree.engine = "pliant";
  tree.threads = 2;
  tree.overlap = "5 %";
  tree.triangles = 80;
  tree.build_seconds = 3;
  brute_force.engine = "brute force";
  brute_force.device = DeviceKind::gpu;
  brute_force.query_seconds = 0.5;
  brute_force.agrees = false;
  CollisionResult result;
  result.rows = {tree, brute_force};
  result.contact_steps = {
      {.device = DeviceKind::gpu, .triangles = 80, .pressing_contacts = 7, .seconds = {{"refit", 0.25}}, .step_seconds = 2}};
  result.notes = {"left out"};
  const auto json = test::ReadJson::parse(to_json({}, {}, result));
  CHECK(json["suite"] == "collision");
  CHECK(json["notes"][0] == "left out");
  const auto first = json["rows"][0], second = json["rows"][1];
  CHECK(first["overlap"] == "5 %");
  CHECK((first["threads"] == 2 && first["triangles"] == 80 && first["build_seconds"] == 3));
  CHECK((second["threads"].is_null() && second["build_seconds"].is_null()));
  CHECK((second["refit_and_query_seconds"] == 0.5 && second["agrees"] == false));
  const auto step = json["contact_steps"][0];
  CHECK((step["device"] == "gpu" && step["threads"].is_null() && step["triangles"] == 80 && step["pressing_contacts"] == 7));
  CHECK((step["refit_seconds"] == 0.25 && step["step_seconds"] == 2));
  CHECK(json["passes"].size() == contact_groups().size());
  CHECK(json["passes"]["contacts"][0] == "find_contacts");
  // The brute force has no threads, no time of building or refitting, and refits no triangles. The query is all of its time.
  const std::string table = to_table(result), row = table.substr(table.find("brute force"));
  std::istringstream text(row.substr(0, row.find('\n')));
  const std::vector<std::string> words(std::istream_iterator<std::string>(text), {});
  CHECK(words == std::vector<std::string>{"brute", "force", "gpu", "-", "-", "-", "500", "500", "-", "0", "differ"});
  CHECK_THAT(table, Catch::Contains(" differ") && Catch::Contains("left out") && Catch::Contains("contacts: find_contacts"));
}

TEST_CASE("a measurement of collisions that is told to end has the rows of cases that were finished") {
  const auto first_case_alone = [](double done, std::string_view) { return done == 0; };
  const CollisionResult result = bench_collision({.devices = {.threads = 1}, .quick = true}, first_case_alone);
  CHECK(result.interrupted);
  CHECK(result.rows.size() == 1);
  int told = 0;
  const auto amid_the_first = [&](double, std::string_view) { return ++told < 3; };
  const CollisionResult cut = bench_collision({.devices = {.threads = 1}, .quick = true}, amid_the_first);
  CHECK((cut.interrupted && told == 3 && cut.rows.empty()));
}

}  // namespace
}  // namespace pliant::bench
