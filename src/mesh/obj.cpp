// Plain text goes the fast way of plain_obj.hpp. Any other goes the strict way, which finds errors: a scan checks every line that
// matters, because tinyobjloader takes nonsense for zero. Then tinyobjloader resolves the faces. Positions come from the scan,
// because tinyobjloader does not round decimals correctly.
#include "mesh/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "core/counted.hpp"
#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/read_text.hpp"
#include "core/thread_pool.hpp"
#include "mesh/compact.hpp"
#include "mesh/plain_obj.hpp"
#include "mesh/report.hpp"

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

namespace pliant {
namespace {

const char* const export_again = "export the mesh again as a text OBJ file";

/// Turns every line end into one '\n' and removes a byte-order mark.
std::string unify_line_ends(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string unified;
  unified.reserve(text.size() + 1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      unified += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      unified += '\n';
  }
  return unified;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F;
}

std::vector<std::string_view> split_words(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  for (std::size_t first = 0; (first = line.find_first_not_of(" \t", first)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", first), line.size());
    words.push_back(line.substr(first, end - first));
    first = end;
  }
  return words;
}

/// Reads the whole word as a number, which is infinite if it is too large for fp64.
std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (status == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);  // 0 or infinity
  return value;
}

std::optional<long long> parse_index(std::string_view word) {
  long long value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

class Scanner {
 public:
  Scanner(std::string text, const std::string& name) : text_(std::move(text)), name_(name) {}

  void scan() {
    check_is_text();
    while (first_ < text_.size()) scan_line(split_words(next_line()));
    if (largest_index_ > static_cast<long long>(positions.size())) {
      line_ = largest_index_line_;
      fail_range(largest_index_);
    }
    if (corner_counts.empty())
      throw Error(ErrorKind::input, name_, "holds no triangles", "soft bodies need a surface: export faces with the vertices");
  }

  std::vector<glm::dvec3> positions;
  std::vector<std::size_t> corner_counts;  // of each face
  std::string relevant_lines;              // v, vt, vn and f, joined and without comments

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw Error(ErrorKind::input, fmt::format("{}:{}", name_, line_), what, remedy);
  }

  [[noreturn]] void fail_range(long long index) const {
    fail(fmt::format("a face names vertex {}, but there are {} vertices", index, positions.size()),
         "count vertices from 1, or backwards from -1");
  }

  void check_is_text() {
    if (text_.find_first_not_of(" \t\n") == std::string::npos) throw Error(ErrorKind::input, name_, "is empty", export_again);
    const auto control = std::ranges::find_if(text_, is_control);
    if (control == text_.end()) return;
    line_ = 1 + static_cast<std::size_t>(std::count(text_.begin(), control, '\n'));
    fail(fmt::format("holds the byte {}, so it is no text", static_cast<int>(static_cast<unsigned char>(*control))),
         export_again);
  }

  /// Joins lines that end in a backslash. Sets line_ to the number of the first.
  std::string next_line() {
    line_ = next_line_number_;
    std::string line;
    while (first_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', first_), text_.size());
      line.append(text_, first_, end - first_);
      first_ = end + 1;
      ++next_line_number_;
      if (!line.ends_with('\\')) break;
      line.back() = ' ';
    }
    return line;
  }

  void scan_line(const std::vector<std::string_view>& words) {
    if (words.empty()) return;
    if (words[0] == "v")
      scan_vertex(words);
    else if (words[0] == "f")
      scan_face(words);
    else if (words[0] == "vt")
      ++texture_count_;
    else if (words[0] == "vn")
      ++normal_count_;
    else
      return;
    for (const std::string_view word : words) relevant_lines.append(word).append(" ");
    relevant_lines.back() = '\n';
  }

  void scan_vertex(const std::vector<std::string_view>& words) {
    if (words.size() < 4) fail(fmt::format("a vertex with {} coordinates", words.size() - 1), "write v x y z");
    for (std::size_t i = 1; i < words.size(); ++i)  // colours and weights are not used, but have to be numbers too
      if (!parse_number(words[i])) fail(fmt::format("\"{}\" is no number", words[i]), "write v x y z");
    positions.emplace_back(coordinate(words[1]), coordinate(words[2]), coordinate(words[3]));
  }

  [[nodiscard]] double coordinate(std::string_view word) const {
    const double value = *parse_number(word);
    if (!std::isfinite(value)) fail(fmt::format("the coordinate {} is not finite", word), "repair the vertex");
    if (std::abs(value) > max_coordinate)
      fail(fmt::format("the coordinate {} is beyond {}", word, max_coordinate),
           "use larger units, or move the mesh to the origin");
    return value;
  }

  void scan_face(const std::vector<std::string_view>& words) {
    if (words.size() < 4) fail(fmt::format("a face with {} corners", words.size() - 1), "faces need at least three");
    for (std::size_t i = 1; i < words.size(); ++i) scan_corner(words[i]);
    corner_counts.push_back(words.size() - 1);
  }

  /// Checks a corner, which is "v", "v/vt", "v//vn" or "v/vt/vn".
  void scan_corner(std::string_view corner) {
    const std::size_t first_slash = std::min(corner.find('/'), corner.size());
    const std::size_t second_slash = std::min(corner.find('/', first_slash + 1), corner.size());
    check_vertex(index_in(corner, corner.substr(0, first_slash)));
    if (first_slash == corner.size()) return;
    const std::string_view texture = corner.substr(first_slash + 1, second_slash - first_slash - 1);
    if (!texture.empty() || second_slash == corner.size()) check_other(index_in(corner, texture), texture_count_, "texture");
    if (second_slash == corner.size()) return;
    check_other(index_in(corner, corner.substr(second_slash + 1)), normal_count_, "normal");
  }

  [[nodiscard]] long long index_in(std::string_view corner, std::string_view word) const {
    const std::optional<long long> index = parse_index(word);
    if (!index) fail(fmt::format("\"{}\" is no corner of a face", corner), "write v, v/vt, v//vn or v/vt/vn");
    if (*index == 0) fail(fmt::format("the corner \"{}\" has the index 0", corner), "indices start at 1");
    return *index;
  }

  void check_vertex(long long index) {
    if (-index > static_cast<long long>(positions.size())) fail_range(index);
    if (index <= largest_index_) return;  // a face may name vertices that follow it, so this is settled at the end
    largest_index_ = index;
    largest_index_line_ = line_;
  }

  void check_other(long long index, long long count, const char* what) const {
    if (std::abs(index) > (index < 0 ? count : 2147483647LL))
      fail(fmt::format("a face names {} {}, but there are {} so far", what, index, count), export_again);
  }

  std::string text_;
  const std::string& name_;
  std::size_t first_ = 0, line_ = 1, next_line_number_ = 1;
  long long texture_count_ = 0, normal_count_ = 0;
  long long largest_index_ = 0;
  std::size_t largest_index_line_ = 0;
};

/// Returns the vertex indices of all faces' corners, one face after the other.
std::vector<std::uint32_t> resolve_corners(const std::string& lines, const std::string& name) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream stream(lines);
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, false))
    throw Error(ErrorKind::input, name, error, export_again);
  std::vector<std::uint32_t> corners;
  for (const tinyobj::shape_t& shape : shapes)
    for (const tinyobj::index_t& index : shape.mesh.indices) corners.push_back(static_cast<std::uint32_t>(index.vertex_index));
  return corners;
}

std::vector<std::array<std::uint32_t, 3>> split_into_fans(const std::vector<std::uint32_t>& corners,
                                                          const std::vector<std::size_t>& corner_counts) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t first = 0;
  for (const std::size_t count : corner_counts) {
    for (std::size_t i = 2; i < count; ++i) triangles.push_back({corners[first], corners[first + i - 1], corners[first + i]});
    first += count;
  }
  PLIANT_EXPECT(first == corners.size());
  return triangles;
}

TriangleMesh parse_strictly(std::string_view text, const std::string& name) {
  Scanner scanner(unify_line_ends(text), name);
  scanner.scan();
  std::vector<std::array<std::uint32_t, 3>> triangles =
      split_into_fans(resolve_corners(scanner.relevant_lines, name), scanner.corner_counts);
  return {std::move(scanner.positions), std::move(triangles)};
}

}  // namespace

LoadedMesh parse_obj(std::string_view text, const std::string& name, const ReadProgress& progress) {
  constexpr std::size_t worth_a_thread = 1 << 20;  // bytes
  const std::size_t part_count = std::min<std::size_t>(1 + text.size() / worth_a_thread, thread_count(0));
  std::optional<TriangleMesh> plain = read_plain_obj(text, part_count, progress);
  LoadedMesh loaded{plain ? std::move(*plain) : parse_strictly(text, name), {}};
  if (const std::size_t count = remove_unused_vertices(loaded.mesh); count > 0)
    loaded.warnings.push_back(counted(count, "vertex is", "vertices are") + " in no face and left out");
  if (const std::size_t count = count_zero_area_triangles(loaded.mesh); count > 0)
    loaded.warnings.push_back(counted(count, "triangle has", "triangles have") + " no area");
  return loaded;
}

LoadedMesh load_obj(const std::filesystem::path& path, const ReadProgress& progress) {
  return parse_obj(read_text(path), path.string(), progress);
}

}  // namespace pliant
