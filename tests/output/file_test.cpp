// Files that appear as a whole.
#include "output/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "core/read_text.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

std::ptrdiff_t count_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

TEST_CASE("a whole file replaces what stood there when it is closed, and not before") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "new" / "file.txt";
  for (const std::string text : {"first", "second"}) {
    const std::string before = std::filesystem::exists(path) ? read_text(path) : "";
    WholeFile file(path);
    file.write(text);
    CHECK((std::filesystem::exists(path) ? read_text(path) : "") == before);
    file.close();
    CHECK(read_text(path) == text);
  }
  CHECK(count_in(path.parent_path()) == 1);
}

TEST_CASE("what stands beside a whole file's place, whatever its name, is left as it is") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file.txt", text = folder.path / "text";
  const std::string own = path.string() + ".tmp-" + std::to_string(getpid());
  std::ofstream(text) << "precious";
  std::ofstream(path.string() + ".tmp") << "precious";
  std::filesystem::create_symlink(text, own);
  std::filesystem::create_symlink("none", own + "-2");
  WholeFile file(path);
  file.write("text");
  file.close();
  CHECK(read_text(path) == "text");
  CHECK(read_text(text) == "precious");
  CHECK(read_text(path.string() + ".tmp") == "precious");
  CHECK(std::filesystem::read_symlink(own) == text);
  CHECK(std::filesystem::is_symlink(own + "-2"));
  CHECK(count_in(folder.path) == 5);
}

TEST_CASE("a whole file that is never closed leaves no trace") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file.txt";
  std::ofstream(path) << "earlier";
  { WholeFile(path).write("half"); }
  CHECK(read_text(path) == "earlier");
  CHECK(count_in(folder.path) == 1);
}

TEST_CASE("a whole file that waits for the disk is the same file") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file.txt";
  std::ofstream(path) << "earlier";
  WholeFile file(path);
  file.write("later");
  file.close_on_disk();
  CHECK(read_text(path) == "later");
  CHECK(count_in(folder.path) == 1);
  WholeFile nowhere("/dev/null");
  CHECK_NOTHROW(nowhere.close_on_disk());
}

TEST_CASE("a file begins empty, or at the end of what there is") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file.txt";
  for (const auto& [begin, after] :
       {std::pair(OutputFile::Begin::at_end, "text"), std::pair(OutputFile::Begin::at_end, "texttext"),
        std::pair(OutputFile::Begin::empty, "text")}) {
    OutputFile file(path, begin);
    file.write("text");
    file.close();
    CHECK(read_text(path) == after);
  }
}

TEST_CASE("a symbolic link stays one, and the file behind it is made or replaced") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file.txt", link = folder.path / "link", further = folder.path / "further";
  std::filesystem::create_symlink("file.txt", link);
  std::filesystem::create_symlink(link, further);
  for (const std::string text : {"first", "second"}) {
    WholeFile file(further);
    file.write(text);
    file.close();
    CHECK(std::filesystem::is_symlink(link));
    CHECK(std::filesystem::is_symlink(further));
    CHECK(read_text(path) == text);
  }
}

TEST_CASE("a device is written to where it is, and a full one is an error") {
  WholeFile nowhere("/dev/null");
  nowhere.write("text");
  nowhere.close();
  CHECK(std::filesystem::is_character_file("/dev/null"));
  WholeFile full("/dev/full");
  full.write("text");
  check_says(error_of([&] { full.close(); }), {"/dev/full", "can't be written"});
}

TEST_CASE("a file is replaceable where there is none yet, and a folder never is") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "file") << "text";
  for (const char* name : {"file", "none", "none/deeper"}) CHECK_NOTHROW(expect_replaceable(folder.path / name));
  CHECK_NOTHROW(expect_replaceable("/dev/null"));
  CHECK(error_of([&] { expect_replaceable(folder.path); }).kind() == ErrorKind::command_line);
}

TEST_CASE("a plain file, or none, is told from pipes, devices and folders, behind links, too") {
  const test::ScratchFolder folder;
  const auto plain = folder.path / "plain", pipe = folder.path / "pipe";
  std::ofstream(plain) << "text";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const auto link_to = [&](const std::filesystem::path& target) {
    const auto link = folder.path / ("link" + std::to_string(count_in(folder.path)));
    std::filesystem::create_symlink(target, link);
    return link;
  };
  for (const auto& path : {plain, folder.path / "none", link_to(plain), link_to("none")})
    CHECK_NOTHROW(expect_plain_or_none(path));
  for (const auto& path : {pipe, folder.path, std::filesystem::path("/dev/null"), link_to(pipe), link_to(folder.path)})
    check_says(error_of([&] { expect_plain_or_none(path); }), {path.c_str(), "is no plain file"});
}

TEST_CASE("a pipe that nobody reads is an error at once, and one with a reader is written to") {
  const test::ScratchFolder folder;
  const auto pipe = folder.path / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  check_says(error_of([&] { OutputFile file(pipe); }), {pipe.c_str(), "is a pipe that nobody reads"});
  WholeFile whole(pipe);
  whole.write("all");
  check_says(error_of([&] { whole.close_on_disk(); }), {pipe.c_str(), "is a pipe that nobody reads"});
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  OutputFile file(pipe);
  file.write("text");
  file.close();
  whole.close_on_disk();
  std::array<char, 16> got{};
  CHECK(read(reader, got.data(), got.size()) == 7);
  CHECK(std::string(got.data()) == "textall");
  close(reader);
}

TEST_CASE("a whole file whose place was taken meanwhile is an error, and leaves nothing beside it") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "a.json";
  WholeFile file(path);
  file.write("text");
  std::filesystem::create_directory(path);
  check_says(error_of([&] { file.close(); }), {"a.json", "can't be replaced"});
  CHECK(std::filesystem::is_directory(path));
  CHECK(count_in(folder.path) == 1);
}

TEST_CASE("a folder can't be replaced by a file") {
  const test::ScratchFolder folder;
  const Error error = error_of([&] { WholeFile file(folder.path); });
  CHECK(error.kind() == ErrorKind::command_line);
}

}  // namespace
}  // namespace pliant
