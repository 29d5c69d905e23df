// Writes files. Every failure becomes an Error, even a full disk.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace pliant {

/// Returns the place that writing to `path` would change. It follows symbolic links, even to a file that does not exist yet.
/// If `path` is not a plain file, such as /dev/stdout, it returns `path` itself.
[[nodiscard]] std::filesystem::path place_behind(const std::filesystem::path& path);

/// Throws Error (command_line) if `path` is a folder, or a file without permission to write.
void expect_replaceable(const std::filesystem::path& path);

/// Throws Error (command_line) if anything but a plain file stands at `path`, or behind a link there. Opening a pipe, for
/// example, may block for ever.
void expect_plain_or_none(const std::filesystem::path& path);

/// Makes missing folders, and tries to make and remove a file beside `path`. Throws Error (command_line) if it can't.
void expect_writable(const std::filesystem::path& path);

class OutputFile {
 public:
  enum class Begin { empty, at_end };

  /// Makes missing folders. It replaces an existing file or goes on at its end. Throws Error (command_line),
  /// also for a pipe that nobody reads.
  explicit OutputFile(const std::filesystem::path& path, Begin begin = Begin::empty);

  void write(std::string_view bytes) { stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }
  /// Makes what was written so far visible to other programs. Throws Error (command_line).
  void flush();
  /// Closes the file. Throws Error (command_line) unless every byte reached it. Without this call a failure goes unnoticed.
  void close();

 private:
  void require(bool good, const char* problem) const;
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// A file that appears as a whole or not at all. close() writes it beside its place, as PATH.tmp-PROCESS or under another unused
/// name, and then moves it there. Before close() nothing is on disk, so a killed program leaves nothing behind. If the path is
/// not a plain file, such as /dev/stdout, close() writes to it directly.
class WholeFile {
 public:
  /// Makes missing folders, and tries to make and remove a file beside `path`. A file at `path` stays as it is until close().
  /// Throws Error (command_line) if it can't.
  explicit WholeFile(const std::filesystem::path& path);

  void write(std::string_view bytes) { bytes_ += bytes; }
  /// Replaces the file at the path. Throws Error (command_line).
  void close();
  /// Does the same, but waits until the disk holds the file before it replaces the old one. After a power cut either the old or
  /// the whole new file is there.
  void close_on_disk();

 private:
  [[nodiscard]] std::filesystem::path write_out() const;  // returns where it has written
  void move(const std::filesystem::path& written) const;
  std::filesystem::path place_;
  bool is_direct_;
  std::string bytes_;
};

}  // namespace pliant
