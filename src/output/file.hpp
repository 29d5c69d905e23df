// A file that a run writes: every failure, a full disk included, becomes an Error.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace pliant {

/// Where what is written to `path` comes to stand: behind symbolic links, whether or not there is a file yet. What is no plain
/// file, such as /dev/stdout, is its own place.
[[nodiscard]] std::filesystem::path place_behind(const std::filesystem::path& path);

/// Throws Error (command_line) where a folder stands at `path`, or a file that one may not write.
void expect_replaceable(const std::filesystem::path& path);

/// Throws Error (command_line) where anything but a plain file stands at `path`, or behind a link there: to open a pipe may take
/// for ever.
void expect_plain_or_none(const std::filesystem::path& path);

/// Makes the folders that are missing, and a file beside `path`, which it removes. Throws Error (command_line) where one may not
/// write.
void expect_writable(const std::filesystem::path& path);

class OutputFile {
 public:
  enum class Begin { empty, at_end };

  /// Creates the folders that are missing, and replaces an existing file or goes on at its end. Throws Error (command_line).
  explicit OutputFile(const std::filesystem::path& path, Begin begin = Begin::empty);

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

/// A file that appears as a whole or not at all: close() writes it beside its place, as PATH.tmp-PROCESS or another name that no
/// file has, and moves it there. Until then there is nothing that a program which is killed would leave behind. What is no plain
/// file, such as /dev/stdout, is written to directly.
class WholeFile {
 public:
  /// Creates the folders that are missing, and tries to make a file there; leaves alone what stands at `path`. Throws Error
  /// (command_line) where one may not write.
  explicit WholeFile(const std::filesystem::path& path);

  void write(std::string_view bytes) { bytes_ += bytes; }
  /// Replaces what stood there. Throws Error (command_line).
  void close();
  /// ... once the disk holds it: after a power cut there is either what stood there or what replaced it.
  void close_on_disk();

 private:
  [[nodiscard]] std::filesystem::path write_out() const;  // says where
  void move(const std::filesystem::path& written) const;
  std::filesystem::path place_;
  bool is_direct_;
  std::string bytes_;
};

}  // namespace pliant
