// Runs the built program as a shell would.
#pragma once
#include <filesystem>
#include <string>

namespace pliant {

struct ProgramResult {
  int exit_code = -1;
  std::string output;  // standard output and error together
};

/// `arguments` is a shell command line behind the program's name.
ProgramResult run_program(const std::string& arguments);

std::string shipped_scene(const std::string& name);  // its path

}  // namespace pliant
