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
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  std::string text(ignored ? 0 : size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (!file.eof()) text.append(std::istreambuf_iterator<char>(file), {});  // if it has grown, or the size is unknown, as in /proc
  if (file.bad()) throw Error(ErrorKind::input, path.string(), "can't be read to its end", "check the disk");
  return text;
}

}  // namespace pliant
