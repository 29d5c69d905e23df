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

}  // namespace pliant
