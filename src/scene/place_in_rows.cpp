#include "scene/place_in_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace pliant {

std::string key_of_place(const glm::uvec3& place) { return fmt::format("[{},{},{}]", place.x, place.y, place.z); }

std::optional<glm::uvec3> place_in(std::string_view key) {
  glm::uvec3 place(0);
  const char* at = key.data();
  for (int i = 0; i < 3; ++i) {
    if (at == key.data() + key.size()) return {};
    const auto [end, error] = std::from_chars(at + 1, key.data() + key.size(), place[i]);
    if (error != std::errc()) return {};
    at = end;
  }
  if (key_of_place(place) != key) return {};
  return place;
}

std::size_t begin_of_place(std::string_view name) {
  const std::size_t bracket = std::min(name.rfind('['), name.size());
  return place_in(name.substr(bracket)) ? bracket : name.size();
}

}  // namespace pliant
