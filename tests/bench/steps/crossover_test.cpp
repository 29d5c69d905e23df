// Times by formula, with a known size at which they are equal.
#include "bench/steps/crossover.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "bench/steps/report.hpp"
#include "bench/steps/steps.hpp"

namespace pliant::bench {
namespace {

constexpr double sizes[] = {100, 400, 1600, 6400};

// factor * vertices^power
std::vector<SizedTime> power_law(double factor, double power) {
  std::vector<SizedTime> times;
  for (const double vertices : sizes) times.push_back({vertices, factor * std::pow(vertices, power)});
  return times;
}

TEST_CASE("two power laws cross where their formulas say, between the sizes measured") {
  const double where = 700;
  const Crossover crossover = find_crossover(power_law(1, 2), power_law(where, 1));
  CHECK(crossover.lead == Lead::crosses);
  REQUIRE(crossover.vertices);
  CHECK(*crossover.vertices == Approx(where));
}

TEST_CASE("where one device is ahead at every size there is nothing to cross") {
  CHECK(find_crossover(power_law(1, 2), power_law(0.5, 2)).lead == Lead::gpu_everywhere);
  CHECK(find_crossover(power_law(0.5, 2), power_law(1, 2)).lead == Lead::cpu_everywhere);
  CHECK_FALSE(find_crossover(power_law(1, 2), power_law(0.5, 2)).vertices);
}

TEST_CASE("of several crossings the last one counts, from which on the GPU stays ahead") {
  const std::vector<SizedTime> cpu = power_law(1, 0);
  const std::vector<SizedTime> gpu = {{100, 0.5}, {400, 2}, {1600, 2}, {6400, 0.5}};
  const Crossover crossover = find_crossover(cpu, gpu);
  REQUIRE(crossover.vertices);
  CHECK(*crossover.vertices == Approx(3200));
}

TEST_CASE("sizes that only one device was measured at don't take part") {
  const std::vector<SizedTime> cpu = {{100, 1}, {400, 8}, {500, 0.001}}, gpu = {{50, 9}, {100, 2}, {400, 4}, {7000, 900}};
  CHECK(find_crossover(cpu, gpu).vertices.value() == Approx(200));
  CHECK(find_crossover(cpu, {}).lead == Lead::none_measured);
}

TEST_CASE("each family has a crossover for every number of CPU threads, and each is told") {
  std::vector<StepsRow> rows;
  for (const double vertices : sizes) {
    const auto row = [&](const char* family, DeviceKind device, unsigned threads, double milliseconds) {
      rows.push_back({.scene = "s",
                      .family = family,
                      .device = device,
                      .threads = threads,
                      .vertices = static_cast<std::uint32_t>(vertices),
                      .milliseconds_per_step = milliseconds});
    };
    row("spheres", DeviceKind::cpu, 1, 1e-3 * vertices);
    row("spheres", DeviceKind::cpu, 8, 1e-4 * vertices);
    row("spheres", DeviceKind::gpu, 1, 0.2);
    row("cubes", DeviceKind::cpu, 1, 1e-9 * vertices);
    row("", DeviceKind::cpu, 1, 1);
    row("", DeviceKind::gpu, 1, 1);
  }
  const std::vector<FamilyCrossover> crossovers = find_crossovers(rows);
  REQUIRE(crossovers.size() == 2);  // none for the family that the GPU lacks, none for scenes as they are
  CHECK(crossovers[0].threads == 1);
  CHECK(crossovers[0].crossover.vertices.value() == Approx(200));
  CHECK(crossovers[1].threads == 8);
  CHECK(crossovers[1].crossover.vertices.value() == Approx(2000));
  const std::string table = to_table(StepsResult{.rows = rows, .crossovers = crossovers, .notes = {"a note"}});
  for (const FamilyCrossover& crossover : crossovers) CHECK_THAT(table, Catch::Contains(to_text(crossover)));
  CHECK_THAT(to_text(crossovers[1]), Catch::Contains("8 CPU threads") && Catch::Contains("2000 vertices"));
  CHECK_THAT(table, Catch::Contains("a note"));
}

}  // namespace
}  // namespace pliant::bench
