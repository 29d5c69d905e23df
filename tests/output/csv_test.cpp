// CSV files, read back.
#include "output/csv.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "sample_model.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using namespace test;

using Table = std::vector<std::vector<std::string>>;

Table read_csv(const std::filesystem::path& path) {
  std::istringstream text(read_text(path));
  Table table;
  for (std::string line; std::getline(text, line);) {
    std::istringstream fields(line);
    table.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
  }
  return table;
}

}  // namespace

TEST_CASE("a final state reads back to the bit") {
  const ScratchFolder folder;
  const auto positions = some_vectors(6), velocities = some_vectors(7);
  write_final_state(folder.path / "final_state.csv", two_bodies(), positions, velocities);
  const Table table = read_csv(folder.path / "final_state.csv");
  REQUIRE(table.size() == 8);
  CHECK(table[0] == std::vector<std::string>{"body", "vertex", "x", "y", "z", "vx", "vy", "vz"});
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& row = table[i + 1];
    REQUIRE(row.size() == 8);
    CHECK(row[0] == (i < 4 ? "0" : "1"));
    CHECK(row[1] == std::to_string(i < 4 ? i : i - 4));
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::stod(row[2 + axis]) == positions[i][axis]);
      CHECK(std::stod(row[5 + axis]) == velocities[i][axis]);
    }
  }
}

TEST_CASE("whatever is not finite is written as nan") {
  const ScratchFolder folder;
  auto positions = some_vectors(6);
  positions[2] = glm::dvec3(std::nan(""), -std::nan(""), std::numeric_limits<double>::infinity());
  write_final_state(folder.path / "final_state.csv", two_bodies(), positions, some_vectors(7));
  const Table table = read_csv(folder.path / "final_state.csv");
  CHECK(table[3][2] == "nan");
  CHECK(table[3][3] == "nan");
  CHECK(table[3][4] == "nan");
}

TEST_CASE("the history grows row by row, with energy as the sum of its parts") {
  const ScratchFolder folder;
  HistoryFile history(folder.path / "run" / "history.csv");
  HistoryRow row;
  history.append(row);
  CHECK(read_csv(folder.path / "run" / "history.csv").size() == 2);  // readable before the run ends
  row = {12, 0.1, 1.5, 0.25, -0.5, {1, 2, 3}, {4, 5, 6}, 3, 40, {7, 8, 9}, 10, 11, 13, 14};
  history.append(row);
  history.close();
  const Table table = read_csv(folder.path / "run" / "history.csv");
  REQUIRE(table.size() == 3);
  REQUIRE(table[0].size() == table[2].size());
  CHECK(table[0] == std::vector<std::string>{"step",
                                             "time",
                                             "kinetic",
                                             "elastic",
                                             "gravitational",
                                             "energy",
                                             "px",
                                             "py",
                                             "pz",
                                             "lx",
                                             "ly",
                                             "lz",
                                             "contact_steps",
                                             "reverted_vertices",
                                             "outside_px",
                                             "outside_py",
                                             "outside_pz",
                                             "contact_given",
                                             "contact_taken",
                                             "friction_work",
                                             "work_of_scripts"});
  const std::vector<double> expected{12, 0.1, 1.5, 0.25, -0.5, 1.25, 1, 2, 3, 4, 5, 6, 3, 40, 7, 8, 9, 10, 11, 13, 14};
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(std::stod(table[2][i]) == expected[i]);
}

TEST_CASE("a history goes on behind the rows of an earlier one, and later rows are gone") {
  const ScratchFolder folder;
  const auto path = folder.path / "history.csv";
  HistoryFile earlier(path);
  earlier.append({.step = 1});
  const std::string so_far = earlier.text();
  earlier.append({.step = 2});
  earlier.close();
  CHECK(earlier.text() == read_text(path));
  HistoryFile later(path, so_far);
  CHECK(read_text(path) == so_far);
  later.append({.step = 3});
  later.close();
  CHECK(later.text() == read_text(path));
  CHECK(read_csv(path)[2][0] == "3");
}

TEST_CASE("a full disk is an error and not a short file") {
  CHECK_THROWS_AS(write_final_state("/dev/full", two_bodies(), some_vectors(1), some_vectors(2)), Error);
  HistoryFile history("/dev/full");
  CHECK_THROWS_AS(history.append({}), Error);
}

}  // namespace pliant
