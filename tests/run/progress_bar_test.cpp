#include "run/progress_bar.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "run/reading_line.hpp"

namespace pliant {

TEST_CASE("a progress bar is filled as far as things have come, and always as wide") {
  const std::string empty = progress_bar(0), half = progress_bar(0.5), full = progress_bar(1);
  CHECK(empty.size() == full.size());
  CHECK(half.size() == full.size());
  CHECK(std::ranges::count(empty, '#') == 0);
  CHECK(2 * std::ranges::count(half, '#') == std::ranges::count(full, '#'));
  CHECK(std::ranges::count(full, ' ') == 2);  // around the number
  CHECK_THAT(half, Catch::EndsWith(" 50 %"));
}

TEST_CASE("a line tells which part of meshes has been read, and never more than all") {
  CHECK(told_reading(0, 400'000'000) == "reading 400 MB of meshes: 0 %");
  CHECK(told_reading(199'999'999, 400'000'000) == "reading 400 MB of meshes: 49 %");
  CHECK(told_reading(800'000'000, 400'000'000) == "reading 400 MB of meshes: 100 %");
}

}  // namespace pliant
