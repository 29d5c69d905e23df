// Runs of a small scene by the program, and what they leave.
#pragma once
#include <catch2/catch.hpp>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "support/json.hpp"
#include "support/scratch.hpp"

namespace pliant::test {

std::size_t line_count(const std::string& text);

/// The summary of a run into this folder.
ReadJson summary_in(const std::filesystem::path& folder);

/// A scene of two small spheres, quick to run. `more` goes into [simulation].
std::filesystem::path small_scene(const ScratchFolder& folder, const std::string& more = "");

/// Checks that the program ends with this exit code, and says all of `parts`.
void check_fails(const std::string& arguments, int exit_code, std::initializer_list<const char*> parts);

}  // namespace pliant::test
