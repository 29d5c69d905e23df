// Runs out of memory. Not for sanitizers: their own memory is beyond any limit.
#pragma once
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PLIANT_CAN_RUN_OUT_OF_MEMORY
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace pliant::test {

/// While it lives, the process gets hardly more memory than it has.
class NoMoreMemory {
 public:
  NoMoreMemory() {
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit tight{pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (16u << 20), before_.rlim_max};
    setrlimit(RLIMIT_AS, &tight);
  }
  ~NoMoreMemory() { setrlimit(RLIMIT_AS, &before_); }
  NoMoreMemory(const NoMoreMemory&) = delete;
  NoMoreMemory& operator=(const NoMoreMemory&) = delete;

 private:
  rlimit before_{};
};

}  // namespace pliant::test
#endif
