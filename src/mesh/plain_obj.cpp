// A reader goes through its part once. It gives up at the first line that is not plain, so it needs no messages.
#include "mesh/plain_obj.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <future>
#include <vector>

namespace pliant {
namespace {

struct MeshPart {
  TriangleMesh mesh;
  std::uint32_t largest_index = 0;  // from 1, of all faces' corners
  bool is_plain = true;
};

/// Whether text holds control characters, or carriage returns that end no line. Both make it unusual.
bool has_odd_characters(std::string_view text) {
  unsigned odd = 0, returns = 0, returns_at_ends = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    odd |= static_cast<unsigned>((c < 0x20) & (c != '\t') & (c != '\n') & (c != '\r')) | static_cast<unsigned>(c == 0x7F);
  }
  if (odd != 0) return true;
  if (text.find('\r') == std::string_view::npos) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    returns += text[i] == '\r';
    returns_at_ends += text[i] == '\n' && i > 0 && text[i - 1] == '\r';
  }
  return returns != returns_at_ends;
}

class PlainReader {
 public:
  PlainReader(std::string_view text, MeshPart& part, const ReadProgress& progress)
      : at_(text.data()), told_(at_), end_(at_ + text.size()), part_(part), progress_(progress) {}

  /// Returns false at a line that is not plain.
  bool read() {
    while (at_ != end_) {
      if (!read_line()) return false;
      if (at_ - told_ >= told_at_once || at_ == end_) tell();
    }
    return true;
  }

 private:
  static constexpr std::ptrdiff_t told_at_once = 1 << 20;  // bytes

  void tell() {
    if (progress_) progress_(static_cast<std::uintmax_t>(at_ - told_));
    told_ = at_;
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t'; }
  bool is_at(char c) const { return at_ != end_ && *at_ == c; }
  bool is_at_end_of_word() const { return at_ == end_ || is_blank(*at_) || *at_ == '\n' || *at_ == '\r' || *at_ == '#'; }
  bool is_at_end_of_words() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r' || *at_ == '#'; }

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  bool read_line() {
    skip_blanks();
    const char word = at_ != end_ ? *at_ : '\n';
    if (word == 'v' || word == 'f') {
      ++at_;
      if (is_at_end_of_word()) return word == 'v' ? read_vertex() : read_face();
    }
    return skip_line();
  }

  /// Passes the rest of the line, whatever it holds. A backslash at its end would join it with the next one.
  bool skip_line() {
    const auto* newline = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    const char* last = newline != nullptr ? newline : end_;
    if (last != at_ && last[-1] == '\r') --last;
    const bool goes_on = last != at_ && last[-1] == '\\';
    at_ = newline != nullptr ? newline + 1 : end_;
    return !goes_on;
  }

  bool read_vertex() {
    glm::dvec3 position;
    for (int axis = 0; axis < 3; ++axis)
      if (!read_number(position[axis]) || !(std::abs(position[axis]) <= max_coordinate)) return false;
    part_.mesh.positions.push_back(position);
    double unused = 0;  // colours and weights
    for (skip_blanks(); !is_at_end_of_words(); skip_blanks())
      if (!read_number(unused)) return false;
    return skip_line();
  }

  bool read_number(double& value) {
    skip_blanks();
    const auto [end, status] = std::from_chars(at_, end_, value);
    at_ = end;
    return status == std::errc() && is_at_end_of_word();
  }

  bool read_face() {
    std::uint32_t first = 0, previous = 0, corner = 0;
    if (!read_corner(first) || !read_corner(previous)) return false;
    do {
      if (!read_corner(corner)) return false;
      part_.mesh.triangles.push_back({first - 1, previous - 1, corner - 1});
      previous = corner;
      skip_blanks();
    } while (!is_at_end_of_words());
    return skip_line();
  }

  /// Reads "v", "v/vt", "v//vn" or "v/vt/vn".
  bool read_corner(std::uint32_t& corner) {
    skip_blanks();
    if (!read_index(corner)) return false;
    part_.largest_index = std::max(part_.largest_index, corner);
    std::uint32_t unused = 0;
    if (is_at('/')) {
      ++at_;
      if (!is_at('/') && !read_index(unused)) return false;
      if (is_at('/')) {
        ++at_;
        if (!read_index(unused)) return false;
      }
    }
    return is_at_end_of_word();
  }

  bool read_index(std::uint32_t& index) {
    const auto [end, status] = std::from_chars(at_, end_, index);
    at_ = end;
    return status == std::errc() && index >= 1 && index <= 0x7fffffff;
  }

  const char* at_;
  const char* told_;  // progress knows of what stands before
  const char* end_;
  MeshPart& part_;
  const ReadProgress& progress_;
};

MeshPart read_part(std::string_view text, const ReadProgress& progress) {
  MeshPart part;
  part.is_plain = !has_odd_characters(text) && PlainReader(text, part, progress).read();
  return part;
}

/// Cuts text behind the line ends that are next to equal parts' ends.
std::vector<std::string_view> cut_at_lines(std::string_view text, std::size_t part_count) {
  std::vector<std::string_view> parts;
  std::size_t first = 0;
  for (std::size_t k = 1; k <= part_count && first < text.size(); ++k) {
    const std::size_t newline = text.find('\n', std::max(first, text.size() * k / part_count));
    const std::size_t end = k == part_count || newline == std::string_view::npos ? text.size() : newline + 1;
    parts.push_back(text.substr(first, end - first));
    first = end;
  }
  return parts;
}

/// Reads each part on a thread of its own. If the system gives no more threads, this one reads the rest.
std::vector<MeshPart> read_parts(const std::vector<std::string_view>& texts, const ReadProgress& progress) {
  std::vector<std::future<MeshPart>> readers;
  for (std::size_t k = 1; k < texts.size(); ++k) readers.push_back(std::async(read_part, texts[k], std::cref(progress)));
  std::vector<MeshPart> parts;
  if (!texts.empty()) parts.push_back(read_part(texts[0], progress));
  for (std::future<MeshPart>& reader : readers) parts.push_back(reader.get());
  return parts;
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::optional<TriangleMesh> read_plain_obj(std::string_view text, std::size_t part_count, const ReadProgress& progress) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) {
    text.remove_prefix(byte_order_mark.size());
    if (progress) progress(byte_order_mark.size());
  }
  TriangleMesh mesh;
  std::uint32_t largest_index = 0;
  for (MeshPart& part : read_parts(cut_at_lines(text, part_count), progress)) {
    if (!part.is_plain) return std::nullopt;
    append(mesh.positions, part.mesh.positions);
    append(mesh.triangles, part.mesh.triangles);
    part.mesh = {};
    largest_index = std::max(largest_index, part.largest_index);
  }
  if (mesh.triangles.empty() || largest_index > mesh.positions.size()) return std::nullopt;
  return mesh;
}

}  // namespace pliant
