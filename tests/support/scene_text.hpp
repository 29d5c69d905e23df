// What tests of scenes share: scenes as text, and the errors that they should be.
#pragma once
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/load_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {

inline const std::string smallest = "[[body]]\nmesh = \"icosphere:1\"\n";

inline SceneDescription load_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path / "scene.toml";
  std::ofstream(file, std::ios::binary) << text;
  return load_scene(file, overrides);
}

inline void check_input_error(const std::string& text, int line, std::initializer_list<const char*> parts) {
  CAPTURE(text);
  const Error error = error_of([&] { return load_text(text); });
  CHECK(error.kind() == ErrorKind::input);
  CHECK_THAT(std::string(error.what()), Catch::Contains("scene.toml:" + std::to_string(line) + ":"));
  check_says(error, parts);
  check_says(error, {"; "});
}

inline void check_override_error(const std::string& text, const char* override_text, std::initializer_list<const char*> parts) {
  CAPTURE(override_text);
  const Error error = error_of([&] { return load_text(text, {override_text}); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"--set ", override_text, "; "});
  check_says(error, parts);
}

inline const std::string two_named =
    "[[body]]\nname = \"left\"\nmesh = \"icosphere:1\"\nstiffness = 40\n[[body]]\nmesh = \"icosphere:2\"\n";

}  // namespace pliant
