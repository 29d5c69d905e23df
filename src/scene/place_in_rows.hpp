// Bodies of one table with a count are told apart by their places in the rows, such as "[0,3,1]".
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace pliant {

/// Returns the text of a place.
[[nodiscard]] std::string key_of_place(const glm::uvec3& place);
/// Returns the place in a text, or nothing if it is none.
[[nodiscard]] std::optional<glm::uvec3> place_in(std::string_view key);
/// Returns where the text of a place begins at the end of a body's name, or the name's length if there is none.
[[nodiscard]] std::size_t begin_of_place(std::string_view name);

}  // namespace pliant
