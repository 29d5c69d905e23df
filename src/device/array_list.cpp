#include "device/array_list.hpp"

#include <algorithm>

namespace pliant {
namespace {

#define ARRAY(name, element, per, life, layout) {#name, #element, #per, ArrayLife::life, layout},
constexpr ArrayRow array_rows[] = {
#include "physics/arrays.glsl"
};
#undef ARRAY

}  // namespace

std::span<const ArrayRow> array_list() { return array_rows; }

const ArrayRow* find_array(std::string_view name) {
  const auto* const found = std::ranges::find(array_rows, name, &ArrayRow::name);
  return found == std::end(array_rows) ? nullptr : found;
}

}  // namespace pliant
