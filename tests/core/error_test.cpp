// What an error says, in one sentence and in parts.
#include "core/error.hpp"

#include <catch2/catch.hpp>

namespace pliant {
namespace {

TEST_CASE("an error says its place, its problem and its remedy, and leaves out what is empty") {
  CHECK(std::string(Error(ErrorKind::input, "a.toml:3", "is wrong", "mend it").what()) == "a.toml:3: is wrong; mend it");
  CHECK(std::string(Error(ErrorKind::input, "", "is wrong", "mend it").what()) == "is wrong; mend it");
  CHECK(std::string(Error(ErrorKind::input, "a.toml:3", "is wrong", "").what()) == "a.toml:3: is wrong");
}

TEST_CASE("an error in a wider place keeps its problem and remedy, and takes on the origin's kind") {
  const Error inner(ErrorKind::input, "a.obj:7", "is wrong", "mend it");
  const Error in_file = inner.within(Origin{Origin::From::file, "scene.toml:2"});
  CHECK(std::string(in_file.what()) == "scene.toml:2: a.obj:7: is wrong; mend it");
  CHECK(in_file.place() == "scene.toml:2: a.obj:7");
  CHECK(in_file.problem() == "is wrong");
  CHECK(in_file.remedy() == "mend it");
  CHECK(in_file.kind() == ErrorKind::input);
  CHECK(inner.within(option_origin("--mesh")).kind() == ErrorKind::command_line);
  CHECK(Error(ErrorKind::device, "", "is wrong", "").within(ErrorKind::device, "here").place() == "here");
  CHECK(inner.within(ErrorKind::input, "").place() == "a.obj:7");
}

}  // namespace
}  // namespace pliant
