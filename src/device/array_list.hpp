// The one list of arrays (physics/arrays.glsl) as a table.
#pragma once
#include <span>
#include <string_view>

namespace pliant {

enum class ArrayLife {
  fixed,    // made from scene and meshes
  carried,  // outlasts a step, and is part of a saved state
  step      // written in a step before it is read there
};

struct ArrayRow {
  std::string_view name;
  std::string_view element;  // a type of the shared dialect, where `real` has the device's precision
  std::string_view per;      // what has one element or several: vertex, body, node, ...
  ArrayLife life;
  std::string_view layout;  // in words, with units
};

[[nodiscard]] std::span<const ArrayRow> array_list();
/// Returns null if there is none of this name.
[[nodiscard]] const ArrayRow* find_array(std::string_view name);

}  // namespace pliant
