// Two holders of one lock at once.
#include "output/file_lock.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/read_text.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

TEST_CASE("a file is one's until the lock goes, by any name, and nothing is left behind") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "new" / "file", link = folder.path / "link";
  std::filesystem::create_symlink(folder.path / "new", link);
  std::optional<FileLock> first(path);
  for (const auto& name : {path, link / "file", folder.path / "new/../new/file"})
    check_says(error_of([&] { FileLock second(name); }), {name.c_str(), "is in use by another run"});
  CHECK_NOTHROW(FileLock(folder.path / "new" / "other"));
  first.reset();
  CHECK_FALSE(std::filesystem::exists(path.string() + ".lock"));
  CHECK_NOTHROW(FileLock(path));
}

TEST_CASE("a file is one's by the name of a link, too, from before it is there on") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file", link = folder.path / "link", further = folder.path / "further";
  std::filesystem::create_symlink("file", link);
  std::filesystem::create_symlink(link, further);
  const FileLock first(further);
  for (const bool is_there : {false, true}) {
    if (is_there) std::ofstream(link) << "written";
    for (const auto& name : {path, link, further})
      check_says(error_of([&] { FileLock second(name); }), {name.c_str(), "is in use by another run"});
  }
}

TEST_CASE("any number read a file at once while none writes it, and the last one leaves nothing behind") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file";
  auto first = std::make_unique<FileLock>(path, FileLock::For::reading);
  auto second = std::make_unique<FileLock>(path, FileLock::For::reading);
  for (auto* reader : {&first, &second}) {
    CHECK_THROWS_AS(FileLock(path), Error);
    reader->reset();
  }
  CHECK_FALSE(std::filesystem::exists(path.string() + ".lock"));
  const FileLock writer(path);
  CHECK_THROWS_AS(FileLock(path, FileLock::For::reading), Error);
}

TEST_CASE("a lock that a program has left behind when it was killed is no obstacle") {
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "file.lock") << "";
  CHECK_NOTHROW(FileLock(folder.path / "file"));
}

TEST_CASE("what is no empty file in a lock's place is left as it is, and there is no lock without it") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file", lock = folder.path / "file.lock", text = folder.path / "text";
  std::ofstream(text) << "precious";
  const std::pair<const char*, std::function<void()>> obstacles[] = {
      {"file", [&] { std::ofstream(lock) << "precious"; }},
      {"folder", [&] { std::filesystem::create_directory(lock); }},
      {"pipe", [&] { REQUIRE(mkfifo(lock.c_str(), 0600) == 0); }},
      {"link to a file", [&] { std::filesystem::create_symlink(text, lock); }},
      {"link to nothing", [&] { std::filesystem::create_symlink("none", lock); }}};
  for (const auto& [what, make] : obstacles) {
    CAPTURE(what);
    make();
    const auto before = std::filesystem::symlink_status(lock).type();
    for (const auto use : {FileLock::For::writing, FileLock::For::reading}) {
      const Error error = error_of([&] { FileLock(path, use); });
      CHECK(error.kind() == ErrorKind::command_line);
      check_says(error, {"file.lock", "not a lock file of pliant"});
    }
    CHECK(std::filesystem::symlink_status(lock).type() == before);
    if (before == std::filesystem::file_type::regular) CHECK(read_text(lock) == "precious");
    std::filesystem::remove(lock);
  }
  CHECK(read_text(text) == "precious");
  CHECK_FALSE(std::filesystem::exists(folder.path / "none"));
}

TEST_CASE("a lock that was written to, or replaced by another file, stays") {
  const test::ScratchFolder folder;
  const auto path = folder.path / "file", lock = folder.path / "file.lock";
  for (const bool is_replaced : {false, true}) {
    {
      const FileLock held(path);
      if (is_replaced) std::filesystem::remove(lock);
      std::ofstream(lock) << (is_replaced ? "" : "precious");
    }
    CHECK(std::filesystem::exists(lock));
    std::filesystem::remove(lock);
  }
}

TEST_CASE("what can't be a place has no lock, nor does the current folder get one") {
  const test::ScratchFolder folder;
  const auto link = folder.path / "link";
  std::filesystem::create_symlink("link", link);
  const FileLock one(link), two(folder.path / std::string(300, 'x'));
  CHECK_FALSE(std::filesystem::exists(".lock"));
}

TEST_CASE("what is no plain file is everyone's, and a place that can't be written is no error yet") {
  const FileLock one("/dev/null"), two("/dev/null");
  CHECK_FALSE(std::filesystem::exists("/dev/null.lock"));
  CHECK_NOTHROW(FileLock("/dev/null/file"));
}

}  // namespace
}  // namespace pliant
