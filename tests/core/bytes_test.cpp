// What is written is what is read.
#include "core/bytes.hpp"

#include <catch2/catch.hpp>

#include "support/expect_error.hpp"

namespace pliant {
namespace {

TEST_CASE("values come back as they were written, and then there are no more") {
  ByteWriter writer;
  writer.put(0.1);
  writer.put_text(std::string("a\0b", 3));
  writer.put_optional(std::optional<int>());
  writer.put_optional(std::optional(7));
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  CHECK(reader.get<double>() == 0.1);
  CHECK(reader.get_text() == std::string("a\0b", 3));
  CHECK_FALSE(reader.get_optional<int>());
  CHECK_FALSE(reader.at_end());
  CHECK(reader.get_optional<int>() == 7);
  CHECK(reader.at_end());
  CHECK(error_of([&] { return reader.get<char>(); }).kind() == ErrorKind::input);
}

TEST_CASE("a text longer than what there is is an error, however long it says it is") {
  for (const std::uint64_t length : {std::uint64_t{4}, ~std::uint64_t{0}}) {
    ByteWriter writer;
    writer.put(length);
    const std::string bytes = writer.take() + "abc";
    CHECK(error_of([&] { return ByteReader(bytes).get_text(); }).kind() == ErrorKind::input);
  }
}

}  // namespace
}  // namespace pliant
