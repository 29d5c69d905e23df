// Tells which pliant this is.
#pragma once
#include <string>

namespace pliant {

/// Returns the version, such as "0.2.0".
[[nodiscard]] std::string version();

/// Returns the commit that it was built from, or "unknown" outside a git checkout. "-dirty" stands behind it if files differed.
[[nodiscard]] std::string commit();

/// Returns both, because bits can change between commits, too.
[[nodiscard]] std::string full_version();

}  // namespace pliant
