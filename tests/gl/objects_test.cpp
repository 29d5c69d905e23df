// Contexts, buffers and programs on every adapter of this machine.
#include "gl/objects.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "core/error.hpp"
#include "gl/context.hpp"
#include "support/no_more_memory.hpp"

using namespace pliant;
using namespace pliant::gl;

TEST_CASE("adapters are numbered in order, hardware before software", "[gl]") {
  std::string reason;
  const auto adapters = list_adapters(&reason);
  INFO(reason);
  REQUIRE_FALSE(adapters.empty());
  for (std::size_t i = 0; i < adapters.size(); ++i) CHECK(adapters[i].index == static_cast<int>(i));
  CHECK(std::ranges::is_sorted(adapters, {}, &Adapter::is_software));
}

TEST_CASE("every adapter opens, says what it is, and llvmpipe is software", "[gl]") {
  for (const Adapter& adapter : list_adapters()) {
    const Context context(adapter.index);
    CHECK(context.adapter().renderer == adapter.renderer);
    CHECK_FALSE(adapter.version.empty());
    if (adapter.renderer.find("llvmpipe") != std::string::npos) CHECK(adapter.is_software);
    if (adapter.vendor.find("NVIDIA") != std::string::npos) CHECK_FALSE(adapter.is_software);
  }
}

TEST_CASE("an adapter that does not exist is an error of kind device", "[gl]") {
  for (int index : {-1, 1000}) {
    try {
      const Context context(index);
      FAIL("a context opened");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::device);
    }
  }
}

TEST_CASE("a context works on after another one of the same device is gone", "[gl]") {
  Context first(0);
  { const Context second(0); }
  first.make_current();
  Buffer buffer(4, "survivor");
  const std::byte sent[4] = {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
  std::byte received[4] = {};
  buffer.write(0, sent);
  buffer.read(0, received);
  CHECK(std::ranges::equal(sent, received));
}

TEST_CASE("a buffer starts at zero and gives back what was written where it was written", "[gl]") {
  const Context context(0);
  Buffer buffer(1001, "bytes");
  std::vector<std::byte> sent(500), received(1001, std::byte{99});
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::byte>(i * 7);
  buffer.read(0, received);
  CHECK(std::ranges::all_of(received, [](std::byte b) { return b == std::byte{0}; }));
  buffer.write(301, sent);
  buffer.read(0, received);
  CHECK(received[300] == std::byte{0});
  CHECK(std::equal(sent.begin(), sent.end(), received.begin() + 301));
  CHECK(received[801] == std::byte{0});
}

TEST_CASE("a large write into a buffer just made arrives whole", "[gl]") {
  const Context context(0);
  std::vector<std::byte> sent(1u << 20), received(1u << 20);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::byte>(i * 13 + i / 256);
  Buffer buffer(sent.size(), "large");
  buffer.write(0, sent);
  buffer.read(0, received);
  CHECK(sent == received);
}

#ifdef PLIANT_CAN_RUN_OUT_OF_MEMORY
TEST_CASE("reading and writing without room for a copy are errors of kind device", "[gl]") {
  const Context context(0);
  if (!context.adapter().is_software) return;  // only its buffers are in the process's memory
  Buffer buffer(100u << 20, "large");
  std::vector<std::byte> data(buffer.size());
  const auto check_no_room = [](const auto& copy) {
    try {
      const test::NoMoreMemory tight;
      copy();
      FAIL("there was room");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::device);
      CHECK_THAT(error.what(), Catch::Contains("no room for 104857600 bytes"));
    }
  };
  check_no_room([&] { buffer.write(0, data); });
  check_no_room([&] { buffer.read(0, data); });
  CHECK_NOTHROW(buffer.read(0, data));
}
#endif

TEST_CASE("a buffer that moved keeps its object and leaves nothing behind", "[gl]") {
  const Context context(0);
  Buffer first(64, "first");
  const auto id = first.id();
  Buffer second = std::move(first);
  CHECK(second.id() == id);
  CHECK(second.size() == 64);
  const Buffer empty(0, "empty");
  CHECK(empty.id() != 0);
}

TEST_CASE("a shader with an error names its true file and line", "[gl]") {
  const Context context(0);
  static constexpr ShaderFile files[] = {
      {"compute/broken.comp", "#version 450\nlayout(local_size_x = 1) in;\n#include \"part.glsl\"\nvoid main() { f(); }\n"},
      {"compute/part.glsl", "// One line, and then\n// another.\nvoid f() { int x = unknown_name; }\n"}};
  const Define defines[] = {{"ONE", "1"}, {"TWO", "2"}};
  try {
    const auto program = Program::compute(flatten_shader(files, "compute/broken.comp", defines), "broken");
    FAIL("it compiled");
  } catch (const Error& error) {
    INFO(error.what());
    CHECK(error.kind() == ErrorKind::device);
    CHECK(std::string(error.what()).find("compute/part.glsl:3") != std::string::npos);
  }
}

TEST_CASE("a good compute shader links", "[gl]") {
  const Context context(0);
  static constexpr ShaderFile files[] = {{"good.comp", "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n"}};
  CHECK(Program::compute(flatten_shader(files, "good.comp"), "good").id() != 0);
}
