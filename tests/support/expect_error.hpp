// Catches the Error that a call is expected to throw.
#pragma once
#include <catch2/catch.hpp>
#include <string>

#include "core/error.hpp"

namespace pliant {

/// Returns the error that `call` throws. The test fails if it throws none.
template <typename Call>
Error error_of(const Call& call) {
  try {
    static_cast<void>(call());
  } catch (const Error& error) {
    return error;
  }
  FAIL("no Error was thrown");
  throw;  // FAIL has thrown
}

/// Whether `error` says all of `parts`.
inline void check_says(const Error& error, std::initializer_list<const char*> parts) {
  for (const char* part : parts) CHECK_THAT(std::string(error.what()), Catch::Contains(part));
}

}  // namespace pliant
