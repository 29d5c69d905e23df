// The memory that a process holds.
#pragma once
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

namespace pliant::test {

/// Returns the resident memory of a process, of this one unless another is named [MiB].
inline double resident_memory(const std::string& process = "self") {
  std::ifstream sizes("/proc/" + process + "/statm");
  long pages = 0, resident = 0;
  REQUIRE(sizes >> pages >> resident);
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace pliant::test
