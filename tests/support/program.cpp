#include "support/program.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "support/paths.hpp"

namespace pliant {

ProgramResult run_program(const std::string& arguments, const std::string& before) {
  std::FILE* pipe = popen((before + program_path() + " " + arguments + " 2>&1").c_str(), "r");
  ProgramResult result;
  std::array<char, 4096> part{};
  while (std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) result.output.append(part.data(), size);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

std::string shipped_scene(const std::string& name) { return source_dir() + "/scenes/" + name + ".toml"; }

}  // namespace pliant
