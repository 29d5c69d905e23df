// The suite `drops`: pliant's bodies keep the laws that it looks at, and Bullet's fall, too, where they are built.
#include "bench/drops/drops.hpp"

#include <catch2/catch.hpp>

#include "bench/drops/report.hpp"
#include "bench/drops/soft_peer.hpp"
#include "support/json.hpp"

namespace pliant::bench {
namespace {

TEST_CASE("the suite drops has rows of both engines, and pliant's bodies stay apart and above the floor") {
  const DropsOptions options{.devices = {.cpu = true, .threads = 1}, .quick = true};
  const DropsResult result = bench_drops(options, [](double, std::string_view) { return true; });
  std::size_t others = 0;
  for (const DropRow& row : result.rows) {
    CAPTURE(row.drop, row.engine);
    CHECK(row.seconds_per_second > 0);
    if (!row.engine.starts_with("pliant")) {
      ++others;
      continue;
    }
    CHECK((row.intersections == 0 && row.depth == 0));
    CHECK(row.most_energy < 1e-3);
    CHECK(row.least_volume > 0.5);
    CHECK(row.last_height < 1);
  }
  CHECK(result.rows.size() - others == 4);
  CHECK(others == 6 * bullet_bodies().size());
  CHECK(result.notes.empty() == !bullet_bodies().empty());
  const auto json = test::ReadJson::parse(to_json({}, options, result));
  CHECK(json["suite"] == "drops");
  CHECK(json["rows"].size() == result.rows.size());
  CHECK_THAT(to_table(result), Catch::Contains("stack of ten"));
}

TEST_CASE("the suite drops ends early if it is told to") {
  const DropsResult result = bench_drops({.devices = {}, .quick = true}, [](double, std::string_view) { return false; });
  CHECK((result.interrupted && result.rows.empty()));
}

}  // namespace
}  // namespace pliant::bench
