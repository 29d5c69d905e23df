// Who may write or read a file, among all programs that ask.
#pragma once
#include <filesystem>

namespace pliant {

/// Keeps a file for one program that writes it, or for those that read it, as long as it lives: by a lock on PATH.lock, which the
/// system lets go with a program that is killed. Paths and symbolic links that lead to one place have one lock; hard links do
/// not.
class FileLock {
 public:
  enum class For { writing, reading };

  /// Makes PATH.lock, and the folders that are missing, or takes an empty one that was left there. Throws Error (command_line)
  /// while another one has it, unless both read, and where anything but an empty file stands there: that is left as it is.
  /// What is no plain file, such as /dev/null, is everyone's; so is a file where there are no locks, or none can be made.
  explicit FileLock(const std::filesystem::path& path, For use = For::writing);
  /// Removes PATH.lock, but for others that read, and unless it has become another file or is empty no more.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path lock_;
  int file_ = -1;  // -1: there is no lock
};

}  // namespace pliant
