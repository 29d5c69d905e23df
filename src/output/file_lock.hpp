// Who may write a file, among all programs that ask.
#pragma once
#include <filesystem>

namespace pliant {

/// Keeps a file for one program, by whatever name, as long as it lives: by a lock on PATH.lock, which the system lets go with a
/// program that is killed.
class FileLock {
 public:
  /// Makes PATH.lock, and the folders that are missing. Throws Error (command_line) while another one has it. What is no plain
  /// file, such as /dev/null, is everyone's; so is a file where there are no locks, or one may not write.
  explicit FileLock(const std::filesystem::path& path);
  /// Removes PATH.lock.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path lock_;
  int file_ = -1;  // -1: there is no lock
};

}  // namespace pliant
