#include "app/failures.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "core/error.hpp"

namespace pliant::app {

int tell_that_output_is_lost(int code) {
  std::fprintf(stderr, "pliant: standard output can't be written; make room or choose another place\n");
  return code != 0 ? code : static_cast<int>(ErrorKind::command_line);
}

int tell_failure(const std::string& who) {
  try {
    throw;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", who.c_str(), error.what());
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: there is not enough memory; take smaller meshes or fewer bodies\n", who.c_str());
    return static_cast<int>(ErrorKind::device);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return tell_that_output_is_lost(0);
    std::fprintf(stderr, "%s: unexpected error: %s; this is a bug, please report it\n", who.c_str(), error.what());
    return 1;
  }
}

}  // namespace pliant::app
