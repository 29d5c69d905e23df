// Writes PNG with stb_image_write, whose code is compiled here.
#include "output/png.hpp"

#include "core/expect.hpp"
#include "output/file.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace pliant {

void write_png(const std::filesystem::path& path, const render::Image& image) {
  PLIANT_EXPECT(image.pixels.size() == std::size_t{3} * image.width * image.height);
  WholeFile file(path);
  const auto write = [](void* context, void* data, int size) {
    static_cast<WholeFile*>(context)->write({static_cast<const char*>(data), static_cast<std::size_t>(size)});
  };
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  PLIANT_EXPECT(stbi_write_png_to_func(write, &file, width, height, 3, image.pixels.data(), 3 * width) != 0);
  file.close();
}

}  // namespace pliant
