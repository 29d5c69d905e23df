#include "output/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace pliant {
namespace {

Error unwritable(const std::filesystem::path& path, const char* problem) {
  return {ErrorKind::command_line, path.string(), problem, "make room and check that you may write there, or name another place"};
}

// If a plain file is protected from writing, it must not be replaced either.
std::filesystem::path checked_place(const std::filesystem::path& path) {
  expect_replaceable(path);
  return place_behind(path);
}

bool is_no_plain_file(const std::filesystem::path& place) {
  std::error_code failure;
  return std::filesystem::exists(place, failure) && !std::filesystem::is_regular_file(place, failure);
}

void make_folder_of(const std::filesystem::path& path) {
  std::error_code failure;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failure);
  if (failure) throw unwritable(path, "its folder can't be made");
}

// Makes an empty file under an unused name, because files beside `place` belong to the user or to other programs.
std::filesystem::path new_file_beside(const std::filesystem::path& place) {
  const std::string first = place.string() + ".tmp-" + std::to_string(getpid());
  std::string name = first;
  int file = -1;
  for (int number = 2; (file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) < 0 && errno == EEXIST;
       ++number)
    name = first + "-" + std::to_string(number);
  if (file < 0) throw unwritable(place, "can't be written");
  ::close(file);
  return name;
}

// Holds a pipe open, so that its reader sees no end before the file is opened. Throws Error (command_line) if nobody reads it,
// because opening it would wait for ever.
class PipeWithReader {
 public:
  explicit PipeWithReader(const std::filesystem::path& path) {
    std::error_code failure;
    if (!std::filesystem::is_fifo(path, failure)) return;
    file_ = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (file_ < 0 && errno == ENXIO)
      throw Error(ErrorKind::command_line, path.string(), "is a pipe that nobody reads", "read it, or name another place");
  }
  ~PipeWithReader() {
    if (file_ >= 0) ::close(file_);
  }
  PipeWithReader(const PipeWithReader&) = delete;
  PipeWithReader& operator=(const PipeWithReader&) = delete;

 private:
  int file_ = -1;
};

// Waits until the disk holds the file, and returns false if writing failed. Devices and some file systems can't wait: the
// result for them is true.
bool is_on_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return true;
  const int result = fsync(file);
  const bool failed = result != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  ::close(file);
  return !failed;
}

}  // namespace

std::filesystem::path place_behind(const std::filesystem::path& path) {
  std::error_code failure;
  const auto behind = std::filesystem::status(path, failure).type();
  if (behind == std::filesystem::file_type::regular) return std::filesystem::canonical(path, failure);
  if (behind == std::filesystem::file_type::not_found && std::filesystem::is_symlink(path, failure))
    return place_behind(path.parent_path() / std::filesystem::read_symlink(path, failure));
  return path;
}

void expect_replaceable(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) return;
  if (std::filesystem::is_directory(path, failure) || access(path.c_str(), W_OK) != 0) throw unwritable(path, "can't be written");
}

void expect_plain_or_none(const std::filesystem::path& path) {
  if (is_no_plain_file(path))
    throw Error(ErrorKind::command_line, path.string(), "is no plain file, and can't be replaced by one", "name another place");
}

OutputFile::OutputFile(const std::filesystem::path& path, Begin begin) : path_(path) {
  make_folder_of(path);
  const PipeWithReader pipe(path);
  stream_.open(path, begin == Begin::at_end ? std::ios::binary | std::ios::app : std::ios::binary);
  require(stream_.good(), "can't be written");
}

void OutputFile::flush() {
  stream_.flush();
  require(stream_.good(), "can't be written to the end");
}

void OutputFile::close() {
  stream_.close();
  require(stream_.good(), "can't be written to the end");
}

void OutputFile::require(bool good, const char* problem) const {
  if (!good) throw unwritable(path_, problem);
}

void expect_writable(const std::filesystem::path& path) { const WholeFile trial(path); }

WholeFile::WholeFile(const std::filesystem::path& path) : place_(checked_place(path)), is_direct_(is_no_plain_file(place_)) {
  if (is_direct_) return;
  make_folder_of(place_);
  const std::filesystem::path trial = new_file_beside(place_);
  std::error_code failure;
  std::filesystem::remove(trial, failure);
  if (failure) throw unwritable(trial, "can't be removed");
}

void WholeFile::close() { move(write_out()); }

void WholeFile::close_on_disk() {
  const std::filesystem::path written = write_out();
  if (!is_on_disk(written)) {
    std::error_code ignored;
    if (!is_direct_) std::filesystem::remove(written, ignored);
    throw unwritable(place_, "can't be written to the end");
  }
  move(written);
  static_cast<void>(is_on_disk(place_.has_parent_path() ? place_.parent_path() : "."));  // the folder's entry for the new name
}

std::filesystem::path WholeFile::write_out() const {
  const std::filesystem::path written = is_direct_ ? place_ : new_file_beside(place_);
  try {
    OutputFile file(written);
    file.write(bytes_);
    file.close();
  } catch (const Error&) {
    std::error_code ignored;
    if (!is_direct_) std::filesystem::remove(written, ignored);
    throw;
  }
  return written;
}

void WholeFile::move(const std::filesystem::path& written) const {
  if (is_direct_) return;
  std::error_code failure, ignored;
  std::filesystem::rename(written, place_, failure);
  if (!failure) return;
  std::filesystem::remove(written, ignored);
  throw unwritable(place_, "can't be replaced");
}

}  // namespace pliant
