// By flock(2).
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
  return stat(path.c_str(), &there) == 0 && fstat(file, &here) == 0 && there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

// An open file with the lock; -1 where none can be made.
int locked(const std::filesystem::path& lock, const std::filesystem::path& path, int operation) {
  const int file = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0 || flock(file, operation | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  close(file);
  throw Error(ErrorKind::command_line, path.string(), "is in use by another run", "wait for its end, or name another place");
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& path, For use) {
  std::error_code failure;
  if (std::filesystem::exists(path, failure) && !std::filesystem::is_regular_file(path, failure)) return;
  lock_ = std::filesystem::weakly_canonical(place_behind(path), failure);
  if (failure) return;  // a link to itself, or a name that is too long: nothing can stand there
  lock_ += ".lock";
  std::filesystem::create_directories(lock_.parent_path(), failure);
  const int operation = use == For::writing ? LOCK_EX : LOCK_SH;
  file_ = locked(lock_, path, operation);
  while (file_ >= 0 && !is_at(lock_, file_)) {  // who had it has removed it meanwhile
    close(file_);
    file_ = locked(lock_, path, operation);
  }
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  std::error_code ignored;
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove(lock_, ignored);  // before it is let go: no other one's
  close(file_);
}

}  // namespace pliant
