// Writes pictures as PNG files.
#pragma once
#include <filesystem>

#include "render/image.hpp"

namespace pliant {

/// Replaces the file at `path` as a whole. Throws Error (command_line) if it can't be written.
void write_png(const std::filesystem::path& path, const render::Image& image);

}  // namespace pliant
