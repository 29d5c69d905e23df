#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "scene/place_in_rows.hpp"

namespace pliant {
namespace {

[[noreturn]] void fail_override(const std::string& place, const std::string& what, const std::string& remedy) {
  throw Error(ErrorKind::command_line, place, what, remedy);
}

const char* const override_form = "write section.key=value or body.NAME.key=value";
const char* const all_grounds = "replace all grounds together, as in --set 'ground=[{height=1}]'";

bool is_bare_word(std::string_view text) {
  return !text.empty() && text.find_first_of(" \t\r\n\"'[]{},=#") == std::string_view::npos;
}

/// Returns a table whose only entry is "value", or nothing if the text is not TOML. `place` becomes every node's source.
std::optional<toml::table> parse_value(const std::string& text, const std::string& place) {
  try {
    toml::table parsed = toml::parse("value = " + text, place);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {  // the caller says what is wrong
  } catch (const TomlAssertion&) {
  }
  return std::nullopt;
}

toml::table parse_value_or_word(const std::string& text, const std::string& place) {
  std::optional<toml::table> parsed = parse_value(text, place);
  if (!parsed && is_bare_word(text)) parsed = parse_value("'" + text + "'", place);
  if (text.empty()) fail_override(place, "has no value", override_form);
  if (!parsed)
    fail_override(place, "the value is no TOML", "put text with spaces in quotation marks, for the shell and for TOML");
  return std::move(*parsed);
}

/// Returns the table below `key`, and makes it if it is absent.
toml::table& table_below(toml::table& table, const std::string& key, const std::string& place) {
  if (table.get(key) == nullptr) table.insert(key, toml::parse("", place));
  toml::table* below = table.get(key)->as_table();
  if (below == nullptr) fail_override(place, fmt::format("\"{}\" is no section", key), override_form);
  return *below;
}

/// Returns null if there is none, and the names of others.
toml::table* table_of_body(toml::table& root, std::string_view name, std::vector<std::string>& names) {
  names.clear();
  toml::array* bodies = root.get_as<toml::array>("body");
  for (std::size_t i = 0; bodies != nullptr && i < bodies->size(); ++i) {
    names.push_back(name_of((*bodies)[i], i));
    if (names.back() == name && (*bodies)[i].is_table()) return (*bodies)[i].as_table();
  }
  return nullptr;
}

/// A name such as "ball[0,3,1]" is of one body in rows. What it has of its own stands below that key in their table.
toml::table& find_body(toml::table& root, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  if (toml::table* table = table_of_body(root, name, names)) return *table;
  if (const std::size_t bracket = begin_of_place(name); bracket < name.size())
    if (toml::table* rows = table_of_body(root, name.substr(0, bracket), names); rows != nullptr && rows->contains("count"))
      return table_below(*rows, name.substr(bracket), place);
  fail_override(place, fmt::format("there is no body \"{}\"", name), suggest(name, names));
}

std::vector<std::string> split_at_dots(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Returns the table in which `key` (such as "collision.tree.max_depth") stands. A body's name may contain dots.
toml::table& table_of(toml::table& root, const std::string& key, const std::string& place) {
  const std::size_t last_dot = key.rfind('.');
  if (last_dot == std::string::npos) return root;
  if (key.starts_with("ground.")) fail_override(place, "grounds have no names to reach them by", all_grounds);
  if (key.starts_with("body.")) {
    if (last_dot < 5) fail_override(place, "names no body, or no key of it", override_form);
    return find_body(root, key.substr(5, last_dot - 5), place);
  }
  toml::table* table = &root;
  for (const std::string& part : split_at_dots(key.substr(0, last_dot))) table = &table_below(*table, part, place);
  return *table;
}

std::string trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

void apply_override(toml::table& root, const std::string& text) {
  const std::string place = std::string(override_prefix) + text;
  const std::size_t equals = text.find('=');
  const std::string key = trim(text.substr(0, equals));
  if (equals == std::string::npos || key.empty()) fail_override(place, "has no key or no \"=\"", override_form);
  toml::table parsed = parse_value_or_word(trim(text.substr(equals + 1)), place);
  toml::table& table = table_of(root, key, place);
  parsed.get("value")->visit([&](auto& value) { table.insert_or_assign(key.substr(key.rfind('.') + 1), std::move(value)); });
}

}  // namespace pliant
