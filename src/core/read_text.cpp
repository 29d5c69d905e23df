#include "core/read_text.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"

namespace pliant {

std::string read_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::input, path.string(), "is a folder", "name a file in it");
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error(ErrorKind::input, path.string(), "is not a plain file", "copy what it holds into one");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path.string(), "can't be opened", "check that the file exists and may be read");
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw Error(ErrorKind::input, path.string(), "can't be read to its end", "check the disk");
  return text;
}

}  // namespace pliant
