// Tells what ended a command.
#pragma once
#include <string>

namespace pliant::app {

/// Is called while an exception is handled. Prints it on standard error, behind `who`, and returns the exit code.
[[nodiscard]] int tell_failure(const std::string& who = "pliant");

/// Says that what a command has printed is lost. Returns the exit code, where `code` would have been the command's.
[[nodiscard]] int tell_that_output_is_lost(int code);

}  // namespace pliant::app
