// Which pliant this is.
#pragma once
#include <string>

namespace pliant {

/// Such as "0.1.0".
[[nodiscard]] std::string version();

/// What it was built from: "-dirty" stands behind it where files differed, and it may be "unknown".
[[nodiscard]] std::string commit();

}  // namespace pliant
