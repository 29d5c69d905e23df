#include "run/reading_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <system_error>

#include "mesh/generators.hpp"

namespace pliant {

std::uintmax_t bytes_of_mesh(const std::string& mesh, const std::filesystem::path& folder) {
  if (is_generator(mesh)) return 0;
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(folder / mesh, failure);
  return failure ? 0 : bytes;
}

std::uintmax_t bytes_of_meshes(const SceneDescription& scene) {
  std::set<std::string> meshes;
  for (const BodyDescription& body : scene.bodies) meshes.insert(body.mesh);
  std::uintmax_t bytes = 0;
  for (const std::string& mesh : meshes) bytes += bytes_of_mesh(mesh, scene.file.parent_path());
  return bytes;
}

// What is read twice counts twice, so that more may be read than there is.
std::string told_reading(std::uintmax_t read, std::uintmax_t bytes) {
  const std::uintmax_t percent = bytes == 0 ? 100 : std::min<std::uintmax_t>(100 * read / bytes, 100);
  return fmt::format("reading {:.0f} MB of meshes: {} %", 1e-6 * static_cast<double>(bytes), percent);
}

ReadingLine::ReadingLine(std::uintmax_t bytes) : bytes_(bytes), is_shown_(bytes >= 20'000'000 && isatty(fileno(stderr)) != 0) {
  show();
}

ReadProgress ReadingLine::progress() {
  return [this](std::uintmax_t bytes) {
    const std::lock_guard lock(mutex_);
    read_ += bytes;
    show();
  };
}

void ReadingLine::show() const {
  if (!is_shown_) return;
  fmt::print(stderr, "\r{:40}", told_reading(read_, bytes_));
  std::fflush(stderr);
}

ReadingLine::~ReadingLine() {
  if (is_shown_) fmt::print(stderr, "\r{:40}\r", "");
}

}  // namespace pliant
