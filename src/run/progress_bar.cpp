#include "run/progress_bar.hpp"

#include <fmt/format.h>

namespace pliant {

std::string progress_bar(double done) {
  return fmt::format("[{:<30}] {:3.0f} %", std::string(static_cast<std::size_t>(30 * done), '#'), 100 * done);
}

}  // namespace pliant
