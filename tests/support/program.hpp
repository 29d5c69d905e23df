// Runs the built program as a shell would.
#pragma once
#include <filesystem>
#include <string>

namespace pliant {

struct ProgramResult {
  int exit_code = -1;
  std::string output;  // standard output and error together
};

/// `arguments` is a shell command line behind the program's name; `before` stands before it, such as "ulimit -v 1000;".
ProgramResult run_program(const std::string& arguments, const std::string& before = "");

std::string shipped_scene(const std::string& name);  // its path

}  // namespace pliant
