// Flattens #include lines, and keeps a table from each line of the result to its file and line.
#include "gl/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

#include "core/error.hpp"

namespace pliant::gl {
namespace {

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

struct Include {
  std::string_view name;
  bool quoted = false;  // else <name>
};

/// Returns the include that this line asks for. Its name is empty if the line asks for none.
Include parse_include(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  if (!line.starts_with("#include")) return {};
  const std::size_t open = line.find_first_of("\"<");
  if (open == std::string_view::npos) return {};
  const std::size_t close = line.find_first_of("\">", open + 1);
  if (close == std::string_view::npos) return {};
  return {line.substr(open + 1, close - open - 1), line[open] == '"'};
}

/// A line of a conditional, as far as flattening may decide it.
enum class Conditional { none, begins, turns, ends };
Conditional conditional_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  if (line.starts_with("#if")) return Conditional::begins;
  if (line.starts_with("#else") || line.starts_with("#elif")) return Conditional::turns;
  return line.starts_with("#endif") ? Conditional::ends : Conditional::none;
}

class Flattener {
 public:
  Flattener(std::span<const ShaderFile> files, std::span<const Define> defines) : files_(files), defines_(defines) {}

  void append(const std::string& name, std::string_view where) {
    const ShaderFile& file = find(name, where);
    if (std::ranges::find(included_, file.name) != included_.end()) return;
    included_.push_back(file.name);
    int line_number = 0;
    for (std::string_view line : split_lines(file.text)) append_line(line, {file.name, ++line_number});
  }

  FlatShader finish() {
    FlatShader flat;
    for (const auto& [text, origin] : lines_) {
      flat.text.append(text).push_back('\n');
      flat.origins.push_back(origin);
    }
    return flat;
  }

  void insert_defines() {
    const auto is_version = [](const Line& line) { return line.text.starts_with("#version"); };
    const auto version = std::ranges::find_if(lines_, is_version);
    auto place = version == lines_.end() ? lines_.begin() : version + 1;
    int number = 0;
    for (const auto& [name, value] : defines_) {
      if (name.starts_with('@') || name.starts_with('!')) continue;
      place = lines_.insert(place, {fmt::format("#define {} {}", name, value), {"<defines>", ++number}}) + 1;
    }
  }

 private:
  struct Line {
    std::string text;
    FlatShader::Origin origin;
  };

  const ShaderFile& find(const std::string& name, std::string_view where) const {
    const auto file = std::ranges::find(files_, std::string_view(name), &ShaderFile::name);
    if (file != files_.end()) return *file;
    throw Error(ErrorKind::device, std::string(where), fmt::format("there is no shader file '{}'", name),
                "rebuild pliant, so that every file below shaders/ is embedded");
  }

  struct Branch {
    bool is_decided, is_kept;  // not decided: the driver does
  };

  // Returns whether the conditional that this line begins is decided here, and whether its first branch stays.
  Branch branch_of(std::string_view line) const {
    for (const auto& [name, value] : defines_) {
      const bool is_defined = !name.starts_with('!');
      const std::string_view plain = std::string_view(name).substr(is_defined ? 0 : 1);
      if (line == fmt::format("#ifdef {}", plain)) return {true, is_defined};
      if (line == fmt::format("#ifndef {}", plain)) return {true, !is_defined};
    }
    return {false, true};
  }

  // Returns whether the line belongs to a conditional that is decided here.
  bool follow_conditional(std::string_view line, FlatShader::Origin origin) {
    const Conditional kind = conditional_of(line);
    if (kind == Conditional::begins) branches_.push_back(branch_of(line));
    if (kind == Conditional::none || branches_.empty() || !branches_.back().is_decided) {
      if (kind == Conditional::ends && !branches_.empty()) branches_.pop_back();
      return false;
    }
    if (kind == Conditional::turns) {
      if (!line.starts_with("#else"))
        throw Error(ErrorKind::device, std::string(origin.file), "'#elif' after a conditional on a define", "use #else and #if");
      branches_.back().is_kept = !branches_.back().is_kept;
    }
    if (kind == Conditional::ends) branches_.pop_back();
    return true;
  }

  void append_line(std::string_view line, FlatShader::Origin origin) {
    const bool is_decided = follow_conditional(line, origin);
    if (is_decided || !std::ranges::all_of(branches_, &Branch::is_kept)) {
      lines_.push_back({"", origin});
      return;
    }
    const Include include = parse_include(line);
    if (include.name.empty()) {
      lines_.push_back({std::string(line), origin});
    } else if (!include.quoted) {
      lines_.push_back({"", origin});
    } else {
      append(resolve(include.name, origin), fmt::format("{}:{}", origin.file, origin.line));
    }
  }

  std::string resolve(std::string_view name, FlatShader::Origin origin) const {
    if (!name.starts_with('@')) {
      const std::string beside = (std::filesystem::path(origin.file).parent_path() / name).lexically_normal().generic_string();
      const bool is_beside = std::ranges::find(files_, std::string_view(beside), &ShaderFile::name) != files_.end();
      return is_beside ? beside : "compute/" + std::string(name);
    }
    const auto define = std::ranges::find(defines_, name, &Define::first);
    if (define != defines_.end()) return define->second;
    throw Error(ErrorKind::device, fmt::format("{}:{}", origin.file, origin.line),
                fmt::format("no file is given for the virtual include '{}'", name), "");
  }

  std::span<const ShaderFile> files_;
  std::span<const Define> defines_;
  std::vector<std::string_view> included_;
  std::vector<Branch> branches_;  // that the line in hand stands in
  std::vector<Line> lines_;
};

/// Cuts off and returns the digits that the text begins with, if any.
std::string_view take_digits(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

struct Complaint {
  std::string_view kind;  // "ERROR: ", "WARNING: " or nothing
  std::size_t line = 0;   // of the flat shader, 0 if that is no number
  std::string_view rest;
};

/// Mesa says "0:12(3): error", NVIDIA "0(12) : error", glslang and others "ERROR: 0:12: ...".
std::optional<Complaint> parse_complaint(std::string_view text) {
  Complaint complaint;
  for (const std::string_view kind : {"ERROR: ", "WARNING: "})
    if (text.starts_with(kind)) complaint.kind = kind;
  text.remove_prefix(complaint.kind.size());
  if (take_digits(text).empty() || text.empty() || (text[0] != ':' && text[0] != '(')) return {};
  const bool is_bracketed = text[0] == '(';
  text.remove_prefix(1);
  const std::string_view digits = take_digits(text);
  if (digits.empty() || (is_bracketed && !text.starts_with(')'))) return {};
  std::from_chars(digits.data(), digits.data() + digits.size(), complaint.line);
  complaint.rest = text.substr(is_bracketed ? 1 : 0);
  return complaint;
}

}  // namespace

FlatShader flatten_shader(std::span<const ShaderFile> files, std::string_view file, std::span<const Define> defines) {
  Flattener flattener(files, defines);
  flattener.append(std::string(file), "");
  flattener.insert_defines();
  return flattener.finish();
}

FlatShader flatten_shader(std::string_view file, std::span<const Define> defines) {
  return flatten_shader(embedded_shaders(), file, defines);
}

std::string FlatShader::explain(std::string_view driver_log) const {
  std::string explained;
  for (const std::string_view line : split_lines(driver_log)) {
    const std::optional<Complaint> complaint = parse_complaint(line);
    if (complaint && complaint->line >= 1 && complaint->line <= origins.size()) {
      const Origin& origin = origins[complaint->line - 1];
      explained += fmt::format("{}{}:{}{}\n", complaint->kind, origin.file, origin.line, complaint->rest);
    } else {
      explained.append(line).push_back('\n');
    }
  }
  return explained;
}

}  // namespace pliant::gl
