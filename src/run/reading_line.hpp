// Shows on a terminal that large files of meshes are being read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

#include "mesh/obj.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Returns how many bytes the files hold that a scene's bodies name, each file once [bytes]. What can't be found counts as 0.
[[nodiscard]] std::uintmax_t bytes_of_meshes(const SceneDescription& scene);
/// The same for a mesh that is no scene's. `mesh` is a file or a generator.
[[nodiscard]] std::uintmax_t bytes_of_mesh(const std::string& mesh, const std::filesystem::path& folder);

/// Returns the line's text.
[[nodiscard]] std::string told_reading(std::uintmax_t read, std::uintmax_t bytes);

/// A line on standard error that stands as long as this lives. There is none if standard error is no terminal, or if so many
/// bytes are read in a moment.
class ReadingLine {
 public:
  explicit ReadingLine(std::uintmax_t bytes);
  ~ReadingLine();
  ReadingLine(const ReadingLine&) = delete;
  ReadingLine& operator=(const ReadingLine&) = delete;

  /// Returns what is to be told of bytes that have been read. This must outlive it.
  [[nodiscard]] ReadProgress progress();

 private:
  void show() const;

  std::mutex mutex_;
  std::uintmax_t bytes_, read_ = 0;
  bool is_shown_;
};

}  // namespace pliant
