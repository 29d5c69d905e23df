// The file holds a magic word, the version, the content's length and checksum, and the content.
#include "output/checkpoint_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "core/bytes.hpp"
#include "core/checksum.hpp"
#include "core/error.hpp"
#include "core/read_text.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

// Built like PNG's signature, so that damage by a transfer as text shows at once.
constexpr std::string_view magic = "\x8bpliant checkpoint\r\n\x1a\n";

std::string header_of(std::string_view content) {
  ByteWriter numbers;
  numbers.put(checkpoint_version);
  numbers.put(std::uint64_t{content.size()});
  numbers.put(checksum(content));
  std::string header(magic);
  header += numbers.take();
  return header;
}

void expect_version(std::uint32_t version, const std::filesystem::path& path) {
  if (version == checkpoint_version) return;
  throw Error(ErrorKind::input, path.string(),
              fmt::format("is a checkpoint of version {}, and this pliant reads version {}", version, checkpoint_version),
              fmt::format("go on with the {} pliant that wrote it", version > checkpoint_version ? "newer" : "older"));
}

bool has_other_content(const std::filesystem::path& path) {
  std::string begin(magic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.gcount() > 0 && !begin.starts_with(magic.substr(0, static_cast<std::size_t>(file.gcount())));
}

}  // namespace

void expect_place_for_checkpoint(const std::filesystem::path& path) {
  expect_plain_or_none(path);
  if (has_other_content(path))
    throw Error(ErrorKind::command_line, path.string(), "is no checkpoint, and would be replaced by one", "name another place");
  expect_writable(path);
}

void write_checkpoint(const std::filesystem::path& path, std::string_view content) {
  WholeFile file(path);
  file.write(header_of(content));
  file.write(content);
  file.close_on_disk();
}

std::string read_checkpoint(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  const auto error = [&](const char* what, const char* remedy) { return Error(ErrorKind::input, path.string(), what, remedy); };
  if (bytes.empty() || !bytes.starts_with(magic.substr(0, bytes.size())))
    throw error("is no checkpoint of pliant", "name a file that --checkpoint wrote");
  if (bytes.size() < header_of("").size()) throw error("is cut short", "take an earlier copy");
  ByteReader header(std::string_view(bytes).substr(magic.size()));
  expect_version(header.get<std::uint32_t>(), path);
  const auto size = header.get<std::uint64_t>(), sum = header.get<std::uint64_t>();
  std::string content = bytes.substr(header_of("").size());
  if (content.size() < size) throw error("is cut short", "take an earlier copy");
  if (content.size() > size || checksum(content) != sum) throw error("is damaged: its checksum is wrong", "take an earlier copy");
  return content;
}

}  // namespace pliant
