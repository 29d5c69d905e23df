// What a test needs of the machine.
#pragma once
#include <catch2/catch.hpp>
#include <cstdlib>

#include "gl/context.hpp"

namespace pliant::test {

/// Whether it is there. Where it is not the test says so; under CI, where all of tools/packages.txt is installed, it fails.
inline bool has(const char* what, bool is_there) {
  if (is_there) return true;
  if (std::getenv("CI") != nullptr) FAIL("there is no " << what);
  WARN("there is no " << what << ": what needs it is left out");
  return false;
}

inline bool has_gl() { return has("OpenGL 4.5", !gl::list_adapters().empty()); }

}  // namespace pliant::test
