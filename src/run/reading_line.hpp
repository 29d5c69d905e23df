// Shows on a terminal that large files of meshes are being read.
#pragma once
#include <cstdint>
#include <filesystem>

#include "scene/scene_description.hpp"

namespace pliant {

/// Returns how many bytes the files hold that a scene's bodies name, each file once [bytes]. What can't be found counts as 0.
[[nodiscard]] std::uintmax_t bytes_of_meshes(const SceneDescription& scene);
/// The same for a mesh that is no scene's. `mesh` is a file or a generator.
[[nodiscard]] std::uintmax_t bytes_of_mesh(const std::string& mesh, const std::filesystem::path& folder);

/// A line on standard error that stands as long as this lives. There is none if standard error is no terminal, or if so many
/// bytes are read in a moment.
class ReadingLine {
 public:
  explicit ReadingLine(std::uintmax_t bytes);
  ~ReadingLine();
  ReadingLine(const ReadingLine&) = delete;
  ReadingLine& operator=(const ReadingLine&) = delete;

 private:
  bool is_shown_;
};

}  // namespace pliant
