// A picture in memory.
#pragma once
#include <cstdint>
#include <vector>

namespace pliant::render {

struct Image {
  std::uint32_t width = 0, height = 0;  // [pixels]
  std::vector<std::uint8_t> pixels;     // red, green, blue in sRGB, row by row from the top left
};

}  // namespace pliant::render
