// Programs of every system stand in for those that pliant would start.
#include "output/program_pipe.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

std::filesystem::path shell() { return find_program("sh").value(); }

TEST_CASE("programs are found on PATH, and others are not") {
  CHECK(std::filesystem::exists(shell()));
  CHECK_FALSE(find_program("a program that nobody has"));
}

TEST_CASE("a program gets every byte, and its arguments as they are") {
  const test::ScratchFolder folder;
  const auto file = folder.path / "got 'all' $of it";
  std::string bytes(3'000'000, '\0');  // more than a pipe holds
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<char>(k * k % 251);
  ProgramPipe pipe(shell(), {"-c", "cat > \"$1\"", "sh", file.string()});
  CHECK(pipe.write(std::as_bytes(std::span(bytes))));
  CHECK(pipe.finish().succeeded);
  CHECK(read_text(file) == bytes);
}

TEST_CASE("a program that ends early takes no more, and its last lines are kept, however much it printed") {
  ProgramPipe pipe(
      shell(),
      {"-c", "head -c 1000000 /dev/zero | tr '\\0' '\\n'; echo first; echo; echo second; echo third; printf last >&2; exit 3"});
  const std::string bytes(1'000'000, 'x');
  while (pipe.write(std::as_bytes(std::span(bytes)))) {
  }
  const ProgramPipe::End end = pipe.finish();
  CHECK_FALSE(end.succeeded);
  CHECK(end.account == "second | third | last");
}

TEST_CASE("a program that a signal ends, or that says nothing, is told of") {
  CHECK_THAT(ProgramPipe(shell(), {"-c", "echo a line; kill -9 $$"}).finish().account,
             Catch::StartsWith("a line, and signal 9 ended it: "));
  CHECK(ProgramPipe(shell(), {"-c", "exit 3"}).finish().account == "it said nothing");
}

TEST_CASE("a pipe that goes lets its program end") {
  const test::ScratchFolder folder;
  const auto file = folder.path / "end";
  { const ProgramPipe pipe(shell(), {"-c", "cat; echo done > \"$1\"", "sh", file.string()}); }
  CHECK(read_text(file) == "done\n");
}

TEST_CASE("what is no program can't be started") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "plain") << "text";
  CHECK_THROWS_AS(ProgramPipe(folder.path / "plain", {}), Error);
  CHECK_THROWS_AS(ProgramPipe(folder.path / "none", {}), Error);
}

}  // namespace
}  // namespace pliant
