#include "output/file.hpp"

#include <system_error>

#include "core/error.hpp"

namespace pliant {

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path) {
  std::error_code failure;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failure);
  require(!failure, "its folder can't be made");
  stream_.open(path, std::ios::binary);
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
  if (!good)
    throw Error(ErrorKind::command_line, path_.string(), problem,
                "make room and check that you may write there, or name another place");
}

}  // namespace pliant
