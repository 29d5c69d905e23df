// Locks with flock(2).
#include "output/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

bool is_at(const std::filesystem::path& path, int file) {
  struct stat there {
  }, here{};
  return lstat(path.c_str(), &there) == 0 && fstat(file, &here) == 0 && there.st_dev == here.st_dev &&
         there.st_ino == here.st_ino;
}

// Pliant's lock files are empty. Any other file belongs to someone else.
bool is_empty_file(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0;
}

Error in_the_way(const std::filesystem::path& lock) {
  return {ErrorKind::command_line, lock.string(), "is not a lock file of pliant, and pliant needs one there",
          "move it, or name another place"};
}

// Opens or makes the lock file. Returns -1 if there is none and none can be made. It follows no link and changes no existing
// file.
int opened(const std::filesystem::path& lock) {
  constexpr int carefully = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  int file = open(lock.c_str(), O_RDWR | O_CREAT | carefully, 0666);
  if (file < 0) file = open(lock.c_str(), O_RDONLY | carefully);  // it may be another user's
  struct stat there {};
  if (file < 0 && lstat(lock.c_str(), &there) == 0 && !(S_ISREG(there.st_mode) && there.st_size == 0)) throw in_the_way(lock);
  if (file < 0 || is_empty_file(file)) return file;
  close(file);
  throw in_the_way(lock);
}

int locked(const std::filesystem::path& lock, const std::filesystem::path& path, int operation) {
  const int file = opened(lock);
  if (file < 0 || flock(file, operation | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  close(file);
  throw Error(ErrorKind::command_line, path.string(), "is in use by another run", "wait for its end, or name another place");
}

}  // namespace

std::filesystem::path FileLock::place_of(const std::filesystem::path& path) {
  std::error_code failure;
  std::filesystem::path place =
      std::filesystem::weakly_canonical(std::filesystem::absolute(place_behind(path), failure), failure);
  if (failure) return {};                                  // a link to itself, or too long a name
  if (!place.has_filename()) place = place.parent_path();  // a folder's name may end with a slash
  return place += ".lock";
}

FileLock::FileLock(const std::filesystem::path& path, For use) {
  std::error_code failure;
  const std::filesystem::file_type type = std::filesystem::status(path, failure).type();
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular &&
      type != std::filesystem::file_type::directory)
    return;
  lock_ = place_of(path);
  if (lock_.empty()) return;
  std::filesystem::create_directories(lock_.parent_path(), failure);
  const int operation = use == For::writing ? LOCK_EX : LOCK_SH;
  file_ = locked(lock_, path, operation);
  while (file_ >= 0 && !is_at(lock_, file_)) {  // the program that had the lock has removed its file meanwhile
    close(file_);
    file_ = locked(lock_, path, operation);
  }
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  std::error_code ignored;
  const bool is_alone = flock(file_, LOCK_EX | LOCK_NB) == 0;
  if (is_alone && is_at(lock_, file_) && is_empty_file(file_)) std::filesystem::remove(lock_, ignored);  // while it is locked
  close(file_);
}

}  // namespace pliant
