// What a test needs of the machine.
#pragma once
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "gl/context.hpp"

namespace pliant::test {

/// Whether it is there. Where it is not the test says so, and leaves out what needs it; under CI, where all of tools/packages
/// is installed, it fails.
inline bool has(const char* what, bool is_there) {
  if (is_there) return true;
  if (std::getenv("CI") != nullptr) FAIL("there is no " << what);
  WARN("there is no " << what << ": what needs it is left out");
  return false;
}

inline bool has_gl() { return has("OpenGL 4.5", !gl::list_adapters().empty()); }

/// Has ctest count the test as skipped (SKIP_REGULAR_EXPRESSION in tests/CMakeLists.txt). The test returns then, before it has
/// checked anything.
inline void skip(const std::string& why) { WARN("this test is skipped: " << why); }

/// Likewise the whole test, where this is not there: `if (lacks(...)) return;`.
inline bool lacks(const char* what, bool is_there) {
  if (!is_there && std::getenv("CI") != nullptr) FAIL("there is no " << what);
  if (!is_there) skip(std::string("there is no ") + what);
  return !is_there;
}

inline bool lacks_gl() { return lacks("OpenGL 4.5", !gl::list_adapters().empty()); }

}  // namespace pliant::test
