#include "scene/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/error.hpp"
#include "core/extension.hpp"

namespace pliant {
namespace {

/// Returns Levenshtein's distance: how many letters to insert, drop or change.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Returns the first line at which toml++'s assertion fails.
std::size_t line_of_assertion(const std::string& text) {
  std::size_t line = 1;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1), ++line) {
    try {
      static_cast<void>(toml::parse(std::string_view(text).substr(0, end)));
    } catch (const TomlAssertion&) {
      break;
    } catch (const toml::parse_error&) {  // a value that goes on in the next line
    }
  }
  return line;
}

}  // namespace

toml::table parse_toml(const std::string& text, const std::filesystem::path& file) {
  const auto fail_at = [&](std::size_t line, const std::string& what) {
    return Error(ErrorKind::input, fmt::format("{}:{}", file.string(), line), what,
                 extension_of(file) == ".obj"
                     ? "a mesh is no scene: show it by pliant view, or name it as the mesh of a body in a scene"
                     : "correct the TOML: texts stand in quotes, numbers are below 1e308, and the file is UTF-8");
  };
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw fail_at(error.source().begin.line, std::string(error.description()));
  } catch (const TomlAssertion&) {
    throw fail_at(line_of_assertion(text), "a malformed key");
  }
}

bool is_override(const toml::node& node) { return node.source().path && node.source().path->starts_with(override_prefix); }

std::string place_of(const toml::node& node) {
  const toml::source_region& source = node.source();
  if (!source.path) return "scene";
  return is_override(node) ? *source.path : fmt::format("{}:{}", *source.path, source.begin.line);
}

Origin origin_of(const toml::node& node, const std::string& path) {
  return {is_override(node) ? Origin::From::override : Origin::From::file,
          path.empty() ? place_of(node) : fmt::format("{}: {}", place_of(node), path)};
}

void fail(const toml::node& node, const std::string& path, const std::string& what, const std::string& remedy) {
  throw Error(origin_of(node, path), what, remedy);
}

std::string type_name(const toml::node& node) {
  if (node.is_string()) return "a string";
  if (node.is_integer()) return "a whole number";
  if (node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "an array";
  return node.is_table() ? "a table" : "a date or time";
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string suggest(std::string_view word, const std::vector<std::string>& names) {
  std::string containing;
  for (const std::string& name : names)
    if (word.size() > 2 && name.find(word) != std::string::npos)
      containing += fmt::format("{}\"{}\"", containing.empty() ? "" : " or ", name);
  if (!containing.empty()) return fmt::format("did you mean {}?", containing);
  const auto nearest = std::ranges::min_element(names, {}, [&](const std::string& name) { return edit_distance(word, name); });
  if (nearest != names.end() && edit_distance(word, *nearest) <= std::max<std::size_t>(2, word.size() / 3))
    return fmt::format("did you mean \"{}\"?", *nearest);
  return "known here: " + list(names);
}

std::string name_of(const toml::node& body, std::size_t index) {
  const toml::table* table = body.as_table();
  const toml::node* name = table != nullptr ? table->get("name") : nullptr;
  return name != nullptr && name->is_string() ? name->as_string()->get() : fmt::format("body{}", index);
}

}  // namespace pliant
