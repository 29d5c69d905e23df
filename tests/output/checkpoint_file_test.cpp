// Whatever happens to the file is noticed.
#include "output/checkpoint_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "core/read_text.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

const std::string content("any\0bytes\xff, as many as there are", 33);

void put(const std::filesystem::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

TEST_CASE("a checkpoint's content comes back, and the one before is replaced") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "new" / "run.checkpoint";
  for (const std::string& written : {content, std::string(), content + content}) {
    write_checkpoint(path, written);
    CHECK(read_checkpoint(path) == written);
  }
}

TEST_CASE("a checkpoint cut short anywhere is refused") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "run.checkpoint";
  write_checkpoint(path, content);
  const std::string whole = read_text(path);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    put(path, whole.substr(0, length));
    const Error error = error_of([&] { return read_checkpoint(path); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"run.checkpoint", length == 0 ? "no checkpoint" : "cut short"});
  }
}

TEST_CASE("a checkpoint with any bit wrong, or with a byte too many, is refused") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "run.checkpoint";
  write_checkpoint(path, content);
  const std::string whole = read_text(path);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    CAPTURE(bit);
    std::string wrong = whole;
    wrong[bit / 8] = static_cast<char>(wrong[bit / 8] ^ (1 << bit % 8));
    put(path, wrong);
    CHECK(error_of([&] { return read_checkpoint(path); }).kind() == ErrorKind::input);
  }
  put(path, whole + "x");
  check_says(error_of([&] { return read_checkpoint(path); }), {"damaged"});
}

TEST_CASE("what is no checkpoint is told from one that is damaged, and one of a newer version from both") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "run.checkpoint";
  put(path, "[[body]]\nmesh = \"icosphere:3\"\n# and so on, for longer than a header\n");
  check_says(error_of([&] { return read_checkpoint(path); }), {"no checkpoint"});
  write_checkpoint(path, content);
  std::string newer = read_text(path);
  newer[newer.find('\x1a') + 2]++;  // the version's first byte
  const std::string next = "version " + std::to_string(checkpoint_version + 1);
  const std::string now = "reads version " + std::to_string(checkpoint_version);
  put(path, newer);
  check_says(error_of([&] { return read_checkpoint(path); }), {"newer pliant", next.c_str(), now.c_str()});
  check_says(error_of([&] { return read_checkpoint(folder.path / "none"); }), {"none", "can't be opened"});
}

TEST_CASE("a checkpoint takes the place of none or of a checkpoint, and of no other file") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "run.checkpoint";
  CHECK_NOTHROW(expect_place_for_checkpoint(path));
  CHECK_FALSE(std::filesystem::exists(path));
  write_checkpoint(path, content);
  CHECK_NOTHROW(expect_place_for_checkpoint(path));
  put(path, "[[body]]\n");
  put(path.string() + ".tmp", "of another program");
  CHECK(error_of([&] { expect_place_for_checkpoint(path); }).kind() == ErrorKind::command_line);
  CHECK(read_text(path) == "[[body]]\n");
  CHECK(read_text(path.string() + ".tmp") == "of another program");
  CHECK(error_of([&] { expect_place_for_checkpoint(folder.path); }).kind() == ErrorKind::command_line);
}

}  // namespace
}  // namespace pliant
