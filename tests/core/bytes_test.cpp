// What is written is what is read.
#include "core/bytes.hpp"

#include <catch2/catch.hpp>

#include "support/expect_error.hpp"

namespace pliant {
namespace {

TEST_CASE("values come back as they were written, and then there are no more") {
  ByteWriter writer;
  writer.put(0.1);
  writer.put(std::string("a\0b", 3));
  writer.put(std::optional<int>());
  writer.put(std::optional(7));
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  CHECK(reader.get<double>() == 0.1);
  CHECK(reader.get<std::string>() == std::string("a\0b", 3));
  CHECK_FALSE(reader.get<std::optional<int>>());
  CHECK_FALSE(reader.at_end());
  CHECK(reader.get<std::optional<int>>() == 7);
  CHECK(reader.at_end());
  CHECK(error_of([&] { return reader.get<char>(); }).kind() == ErrorKind::input);
}

TEST_CASE("what one function visits for writing it visits for reading") {
  struct Values {
    int number = 0;
    std::filesystem::path path;
    std::vector<std::string> texts;
    std::vector<std::optional<double>> numbers;
  };
  const auto visit = [](auto& archive, auto& values) { archive(values.number, values.path, values.texts, values.numbers); };
  const Values written{7, "a/b", {"one", "", "three"}, {0.5, std::nullopt}};
  ByteWriter writer;
  visit(writer, written);
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  Values read{1, "c", {"left over"}, {}};
  visit(reader, read);
  CHECK(reader.at_end());
  CHECK(read.number == written.number);
  CHECK(read.path == written.path);
  CHECK(read.texts == written.texts);
  CHECK(read.numbers == written.numbers);
}

TEST_CASE("a text longer than what there is is an error, however long it says it is") {
  for (const std::uint64_t length : {std::uint64_t{4}, ~std::uint64_t{0}}) {
    ByteWriter writer;
    writer.put(length);
    const std::string bytes = writer.take() + "abc";
    CHECK(error_of([&] { return ByteReader(bytes).get<std::string>(); }).kind() == ErrorKind::input);
  }
}

}  // namespace
}  // namespace pliant
