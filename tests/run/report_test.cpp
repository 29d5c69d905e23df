// What a run warns of at its end.
#include "run/report.hpp"

#include <catch2/catch.hpp>
#include <limits>

namespace pliant {
namespace {

TEST_CASE("parts of steps in which no body moved are told, with their number") {
  StepReport report;
  CHECK(contact_troubles_of(report, 1000, 64).empty());
  report.held_parts = 17;
  const std::vector<std::string> told = contact_troubles_of(report, 1000, 64);
  REQUIRE(told.size() == 1);
  CHECK_THAT(told[0], Catch::Contains("no body moved in 17 parts of steps"));
}

TEST_CASE("motions that were cut short are told from 1 % of those in contact on, and from 100 on") {
  const auto is_told = [](std::uint64_t cuts, std::uint64_t contact_steps, std::uint64_t vertices) {
    StepReport report;
    report.reverted_vertices = cuts;
    report.contact_steps = contact_steps;
    return !contact_troubles_of(report, vertices, 64).empty();
  };
  CHECK(is_told(100, 1, 100));
  CHECK_FALSE(is_told(99, 1, 100));
  CHECK(is_told(100, 0, 100));  // no contact gave an impulse
  CHECK(is_told(10'000, 1'000, 1'000));
  CHECK_FALSE(is_told(9'999, 1'000, 1'000));
  CHECK_FALSE(is_told(0, 0, 100));
}

TEST_CASE("only who has doubles left to take is told to take them for motions that were cut short") {
  StepReport report;
  report.reverted_vertices = 100;
  CHECK_THAT(contact_troubles_of(report, 100, 32).at(0), Catch::Contains("--precision 64"));
  CHECK_THAT(contact_troubles_of(report, 100, 64).at(0), !Catch::Contains("--precision"));
}

TEST_CASE("a shorter time step is no remedy for motions cut short where a tolerance makes steps, and a fixed one is") {
  StepReport report;
  report.reverted_vertices = 100;
  CHECK_THAT(contact_troubles_of(report, 100, 64).at(0), Catch::Contains("or a shorter time step"));
  report.adaptive.emplace();
  CHECK_THAT(contact_troubles_of(report, 100, 64).at(0), Catch::Contains("or a fixed time_step in place of the tolerance"));
}

TEST_CASE("lists of clusters are named for growth if they changed half as much, and as a possible cause if nobody knows") {
  const auto cause = [](double by_lists, std::uint64_t contact_steps) {
    StepReport report;
    report.contact_steps = contact_steps;
    return cause_of_growth(2, by_lists, report, "a shorter time step");
  };
  CHECK_THAT(cause(1, 0), Catch::Contains("lists of clusters that were made anew have changed it"));
  for (const std::uint64_t contact_steps : {0u, 1u}) {
    const std::string other = cause(0.99, contact_steps);
    CHECK_THAT(other, !Catch::Contains("lists") && Catch::Contains("unstable") && Catch::EndsWith("; try a shorter time step"));
    CHECK((other.find("contacts") != std::string::npos) == (contact_steps > 0));
    const std::string unknown = cause(std::numeric_limits<double>::quiet_NaN(), contact_steps);
    CHECK_THAT(unknown, Catch::StartsWith("lists of clusters that were made anew may have changed it, or " +
                                          other.substr(0, other.find(';'))) &&
                            Catch::EndsWith("damping or a shorter time step"));
  }
}

}  // namespace
}  // namespace pliant
