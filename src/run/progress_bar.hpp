// Shows on a terminal how far a command has come.
#pragma once
#include <string>

namespace pliant {

/// Returns text such as "[###############               ]  50 %". `done` is from 0 to 1.
[[nodiscard]] std::string progress_bar(double done);

}  // namespace pliant
