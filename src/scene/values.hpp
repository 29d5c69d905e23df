// What a value of a scene must be: its type, its range, or one of several words. convert() checks that, and throws Error (input)
// that says what to write.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "scene/toml.hpp"

namespace pliant {

struct Range {
  double lowest, highest;
  const char* text;  // what to write
};

inline constexpr Range positive{1e-30, 1e30, "a number above 0 (1e-30 to 1e30)"};
inline constexpr Range box_side{1e-6, 1e6, "a number from 1e-6 to 1e6"};
inline constexpr Range error_tolerance{1e-14, 0.1, "a number from 1e-14 to 0.1"};
inline constexpr Range positive_or_auto{1e-30, 1e30, "a number above 0 (1e-30 to 1e30), or \"auto\""};
inline constexpr Range not_negative{0, 1e30, "a number from 0 to 1e30"};
inline constexpr Range coordinate{-1e9, 1e9, "a number from -1e9 to 1e9"};
inline constexpr Range fraction{0, 1, "a number from 0 to 1"};
inline constexpr Range edge_part{0.01, 0.1, "a number from 0.01 to 0.1"};
inline constexpr Range view_angle{1, 179, "a number from 1 to 179"};
inline constexpr Range fan_out{2, 8, "2, 4 or 8"};
inline constexpr Range tree_depth{1, 64, "a whole number from 1 to 64"};
inline constexpr Range triangle_count{1, 1e6, "a whole number from 1 to 1000000"};
inline constexpr Range frames_per_second{1e-6, 1e6, "a number from 1e-6 to 1e6"};
inline constexpr Range pixel_count{1, 16384, "a whole number from 1 to 16384"};
inline constexpr Range row_length{1, 65535, "a whole number from 1 to 65535"};
inline constexpr Range force_tolerance{1e-8, 0.1, "a number from 1e-8 to 0.1"};
inline constexpr Range subdivisions{0, most_subdivisions, "a whole number from 0 to 15"};

template <typename Enum>
struct Choice {
  const char* name;
  Enum value;
};

void convert(const toml::node& node, const std::string& path, double& value, const Range& range);
void convert(const toml::node& node, const std::string& path, unsigned& value, const Range& range);
void convert(const toml::node& node, const std::string& path, std::string& value);
void convert(const toml::node& node, const std::string& path, bool& value);
void convert(const toml::node& node, const std::string& path, Named& named);

template <typename T, typename... How>
void convert(const toml::node& node, const std::string& path, std::optional<T>& value, const How&... how) {
  convert(node, path, value.emplace(), how...);
}

template <int length, typename T, glm::qualifier precision>
void convert(const toml::node& node, const std::string& path, glm::vec<length, T, precision>& value, const Range& range) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != length)
    fail(node, path, array ? fmt::format("has {} elements", array->size()) : fmt::format("is {}", type_name(node)),
         fmt::format("write an array of {}, each {}", length, range.text));
  for (int i = 0; i < length; ++i)
    convert((*array)[static_cast<std::size_t>(i)], fmt::format("{}[{}]", path, i), value[i], range);
}

template <typename Enum>
void convert(const toml::node& node, const std::string& path, Enum& value, const std::vector<Choice<Enum>>& choices) {
  std::string name;
  convert(node, path, name);
  const auto found = std::ranges::find(choices, name, &Choice<Enum>::name);
  std::vector<std::string> names;
  for (const Choice<Enum>& choice : choices) names.emplace_back(choice.name);
  if (found == choices.end()) fail(node, path, fmt::format("\"{}\" is no choice", name), "write one of " + list(names));
  value = found->value;
}

}  // namespace pliant
