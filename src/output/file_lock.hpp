// Lets pliant's programs take turns at writing and reading a file, or writing into a folder.
#pragma once
#include <filesystem>

namespace pliant {

/// Reserves a file or folder for one program that writes it, or for several that read it, while the object lives. It locks
/// PATH.lock. The system releases the lock of a killed program. Paths and symbolic links to the same place share one lock, but
/// hard links do not.
class FileLock {
 public:
  enum class For { writing, reading };

  /// Returns PATH.lock in full, with links followed. Empty if no file can exist there.
  [[nodiscard]] static std::filesystem::path place_of(const std::filesystem::path& path);

  /// Makes PATH.lock and missing folders, or takes an empty PATH.lock that was left there. Throws Error (command_line) if
  /// - another program has the lock, unless both read
  /// - anything but an empty file stands at PATH.lock, which stays as it is.
  ///
  /// There is no lock, and no error, if
  /// - `path` is neither a plain file nor a folder, such as /dev/null
  /// - the file system has no locks, or no lock file can be made.
  explicit FileLock(const std::filesystem::path& path, For use = For::writing);
  /// Removes PATH.lock, unless other programs still read, or it was replaced or written to meanwhile.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path lock_;
  int file_ = -1;  // -1: there is no lock
};

}  // namespace pliant
