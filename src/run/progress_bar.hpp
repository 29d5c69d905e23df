// How far something has come, as commands show it on a terminal.
#pragma once
#include <string>

namespace pliant {

/// Such as "[###############               ]  50 %"; `done` is from 0 to 1.
[[nodiscard]] std::string progress_bar(double done);

}  // namespace pliant
