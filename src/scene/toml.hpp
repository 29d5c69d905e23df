// TOML as scenes are read from it. Only files of this folder see toml++.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/origin.hpp"

namespace pliant {
struct TomlAssertion {};
[[noreturn]] inline void fail_toml_assertion() { throw TomlAssertion(); }
}  // namespace pliant

// toml++ 3.3 takes some malformed keys, such as [.a], for bugs of its own. Then an assertion fails, or under NDEBUG its behaviour
// is undefined.
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : pliant::fail_toml_assertion())
#include <toml++/toml.h>

namespace pliant {

/// Returns the table in `text`. `file` becomes every node's source. Throws Error (input) that names the line.
[[nodiscard]] toml::table parse_toml(const std::string& text, const std::filesystem::path& file);

/// toml++ keeps only a path as a node's source. This prefix marks the path of an override.
inline constexpr std::string_view override_prefix = "--set ";

/// Returns "file:line", or the override that made the node.
[[nodiscard]] std::string place_of(const toml::node& node);
/// Returns whether an override made the node.
[[nodiscard]] bool is_override(const toml::node& node);
/// Returns where the value at `path` (such as "body.left.mass") was given.
[[nodiscard]] Origin origin_of(const toml::node& node, const std::string& path);
/// Throws Error of the value at `path`.
[[noreturn]] void fail(const toml::node& node, const std::string& path, const std::string& what, const std::string& remedy);

/// Returns the node's type in words, with an article.
[[nodiscard]] std::string type_name(const toml::node& node);
/// Returns the name of the `index`-th body, or its default.
[[nodiscard]] std::string name_of(const toml::node& body, std::size_t index);

/// Returns the names, with commas between them.
[[nodiscard]] std::string list(const std::vector<std::string>& names);
/// Suggests the names that contain the word, such as vertex_mass for mass. If there is none, suggests the nearest name. If
/// nothing is near, lists all names.
[[nodiscard]] std::string suggest(std::string_view word, const std::vector<std::string>& names);

}  // namespace pliant
