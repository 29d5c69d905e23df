// Where the project and the built program are. Tests that run on another machine can replace what the build knew by environment
// variables of the same names.
#pragma once
#include <cstdlib>
#include <string>

namespace pliant {

inline std::string from_environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

inline std::string source_dir() { return from_environment("PLIANT_SOURCE_DIR", PLIANT_SOURCE_DIR); }
inline std::string program_path() { return from_environment("PLIANT_PROGRAM", PLIANT_PROGRAM); }

}  // namespace pliant
