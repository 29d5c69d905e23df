// Pictures as files.
#include "output/png.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "support/expect_error.hpp"
#include "support/scratch.hpp"

using namespace pliant;

TEST_CASE("a written PNG has the signature and the size of its picture") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "picture.png";
  const render::Image image{3, 2, std::vector<std::uint8_t>(18, 77)};
  write_png(path, image);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  REQUIRE(bytes.size() > 24);
  CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(bytes.substr(16, 8) == std::string("\0\0\0\3\0\0\0\2", 8));  // width and height, big-endian
}

TEST_CASE("a PNG that cannot be written is an error with a remedy") {
  const auto failure = error_of([] { return write_png("/dev/null/picture.png", {1, 1, {1, 2, 3}}), 0; });
  CHECK(failure.kind() == ErrorKind::command_line);
  check_says(failure, {"/dev/null/picture.png", "another place"});
}
