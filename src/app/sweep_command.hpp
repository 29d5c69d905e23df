// `pliant sweep`: starts the sweep of the Python package.
#pragma once
#include <string>
#include <vector>

namespace pliant::app {

/// Runs `python3 -m pliant.sweep` with these arguments in this process's place, so it never returns. Throws Error (device) if
/// there is no Python, or if that Python lacks the package.
[[noreturn]] void sweep(const std::vector<std::string>& arguments);

}  // namespace pliant::app
