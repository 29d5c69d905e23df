// Reads a table of a scene file, or one in front of another, and remembers which keys it was asked for.
#pragma once
#include <fmt/format.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/origin.hpp"
#include "scene/toml.hpp"
#include "scene/values.hpp"

namespace pliant {

/// Reads keys of one table, or of another one in front of it. Whatever they hold beyond these keys is an error in finish().
class TableReader {
 public:
  TableReader(const toml::table& table, std::string path, const toml::table* front = nullptr, std::string front_path = "")
      : table_(table), front_(front), path_(std::move(path)), front_path_(std::move(front_path)) {}

  /// Leaves `value` as it is when the key is absent. `how` is a range or a list of choices.
  template <typename T, typename... How>
  void read(const char* key, T& value, const How&... how) {
    if (const toml::node* node = find(key)) convert(*node, path_of(key), value, how...);
  }

  /// Reads the table below `key` by read_value(TableReader&, T&).
  template <typename T, typename Read>
  void section(const char* key, T& value, const Read& read_value) {
    if (const toml::node* node = find(key)) section(*node, path_of(key), value, read_value);
  }

  template <typename T, typename Read>
  void section(const char* key, std::optional<T>& value, const Read& read_value) {
    if (const toml::node* node = find(key)) section(*node, path_of(key), value.emplace(), read_value);
  }

  template <typename T, typename Read>
  static void section(const toml::node& node, const std::string& path, T& value, const Read& read_value) {
    if (!node.is_table()) fail(node, path, fmt::format("is {}", type_name(node)), fmt::format("write a table, as in [{}]", path));
    TableReader reader(*node.as_table(), path);
    read_value(reader, value);
    reader.finish();
  }

  void require(const char* key) const;

  /// If both are there, the stronger one replaces the other: see peek(). Call it before either is read.
  void keep_one_of(const char* first, const char* second);

  /// Returns null if the key is absent. An override is stronger than the file, and the table in front than the one behind.
  /// Does not make the key a known one.
  [[nodiscard]] const toml::node* peek(const char* key) const;

  /// Whether peek() takes the key from the table in front.
  [[nodiscard]] bool is_in_front(std::string_view key) const;

  /// Forgets what the table behind says of keys that the one in front lacks.
  void forget_behind(std::initializer_list<const char*> keys);

  /// Makes a key known that others read.
  void know(const char* key) { known_.emplace_back(key); }

  /// Does what peek() does, and makes the key a known one.
  const toml::node* find(const char* key);

  /// Returns an origin from nowhere if the key is absent.
  [[nodiscard]] Origin where(const char* key) const;

  /// Adds where those of the keys stand that are there.
  void note(std::initializer_list<const char*> keys, std::vector<Origin>& found) const;

  /// Returns the key with its tables, such as "collision.tree.split".
  [[nodiscard]] std::string path_of(std::string_view key) const;

  /// Throws Error (input or command_line) of a key that is not a known one.
  void finish() const;

 private:
  void expect_known(std::string_view key, const toml::node& node) const;

  const toml::table& table_;
  const toml::table* front_;
  std::string path_, front_path_;              // such as "collision.tree"
  std::vector<std::string> known_, replaced_;  // keys
};

}  // namespace pliant
