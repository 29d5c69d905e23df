// What a test needs of the machine.
#pragma once
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "gl/context.hpp"

namespace pliant::test {

/// Returns whether it is there. If it is not, the test says so, and leaves out what needs it. Under CI, where all packages are
/// installed, the test fails instead.
inline bool has(const char* what, bool is_there) {
  if (is_there) return true;
  if (std::getenv("CI") != nullptr) FAIL("there is no " << what);
  WARN("there is no " << what << ": what needs it is left out");
  return false;
}

inline bool has_gl() { return has("OpenGL 4.5", !gl::list_adapters().empty()); }

/// Makes ctest count the test as skipped (SKIP_REGULAR_EXPRESSION in tests/CMakeLists.txt). The test then has to return before it
/// checks anything.
inline void skip(const std::string& why) { WARN("this test is skipped: " << why); }

/// Skips the whole test if this is not there: `if (lacks(...)) return;`. Under CI the test fails instead.
inline bool lacks(const char* what, bool is_there) {
  if (!is_there && std::getenv("CI") != nullptr) FAIL("there is no " << what);
  if (!is_there) skip(std::string("there is no ") + what);
  return !is_there;
}

inline bool lacks_gl() { return lacks("OpenGL 4.5", !gl::list_adapters().empty()); }

}  // namespace pliant::test
