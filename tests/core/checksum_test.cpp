// Values from the authors' own list, and what a checksum is for.
#include "core/checksum.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace pliant {
namespace {

TEST_CASE("checksums are those of FNV-1a") {
  CHECK(checksum("") == 0xcbf29ce484222325u);
  CHECK(checksum("a") == 0xaf63dc4c8601ec8cu);
  CHECK(checksum("foobar") == 0x85944171f73967e8u);
}

TEST_CASE("a checksum goes on from the bytes before") {
  const std::string first = "foo", second = "bar";
  CHECK(checksum(std::as_bytes(std::span(second)), checksum(first)) == checksum("foobar"));
}

}  // namespace
}  // namespace pliant
