// A file that a run writes: every failure, a full disk included, becomes an Error.
#pragma once
#include <filesystem>
#include <fstream>
#include <string_view>

namespace pliant {

class OutputFile {
 public:
  /// Creates the folders that are missing and replaces an existing file. Throws Error (command_line).
  explicit OutputFile(const std::filesystem::path& path);

  void write(std::string_view bytes) { stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }
  /// Makes what was written so far visible to other programs. Throws Error (command_line).
  void flush();
  /// Throws Error (command_line) unless every byte reached the file. Without it a failure goes unnoticed.
  void close();

 private:
  void require(bool good, const char* problem) const;
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// A file that appears as a whole or not at all: it is written beside its place, as PATH.tmp, and close() moves it there. What is
/// no plain file, such as /dev/stdout, is written to directly.
class WholeFile {
 public:
  /// Creates the folders that are missing, and PATH.tmp; leaves alone what stands at `path`. Throws Error (command_line) where
  /// one may not write.
  explicit WholeFile(const std::filesystem::path& path);
  /// Removes PATH.tmp, unless close() has moved it.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view bytes) { file_.write(bytes); }
  /// Replaces what stood there. Throws Error (command_line).
  void close();

 private:
  std::filesystem::path place_, written_;  // the same where it is written directly
  OutputFile file_;
  bool moved_ = false;
};

}  // namespace pliant
