// The memory that a process holds.
#pragma once
#include <malloc.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

namespace pliant::test {

/// Returns the resident memory of a process [MiB].
inline double resident_memory(const std::string& process) {
  std::ifstream sizes("/proc/" + process + "/statm");
  long pages = 0, resident = 0;
  REQUIRE(sizes >> pages >> resident);
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Returns the resident memory of this process, without what has been freed [MiB]. Without malloc_trim that swings by 100 MiB
/// where a program frees large blocks below small ones.
inline double trimmed_resident_memory() {
  malloc_trim(0);
  return resident_memory("self");
}

}  // namespace pliant::test
