#include "run/reading_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

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

ReadingLine::ReadingLine(std::uintmax_t bytes) : is_shown_(bytes >= 20'000'000 && isatty(fileno(stderr)) != 0) {
  if (is_shown_) fmt::print(stderr, "\rreading {:.0f} MB of meshes ", static_cast<double>(bytes) / 1e6);
  std::fflush(stderr);
}

ReadingLine::~ReadingLine() {
  if (is_shown_) fmt::print(stderr, "\r{:40}\r", "");
}

}  // namespace pliant
