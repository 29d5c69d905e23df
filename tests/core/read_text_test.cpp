#include "core/read_text.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "support/scratch.hpp"

namespace pliant {

TEST_CASE("a file is read whole, with every byte") {
  const test::ScratchFolder folder;
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>(i);
  for (const std::string& text : {std::string(), std::string("\r\n\x1a\0 ", 5), bytes}) {
    std::ofstream(folder.path / "text", std::ios::binary) << text;
    CHECK(read_text(folder.path / "text") == text);
  }
}

TEST_CASE("a file whose size the system does not tell is read to its end") {
  if (std::filesystem::exists("/proc/self/status")) CHECK_THAT(read_text("/proc/self/status"), Catch::Contains("Name:"));
}

}  // namespace pliant
