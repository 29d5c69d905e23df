#include "collision/responses/response.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "collision/responses/impulse.hpp"
#include "collision/responses/reflect.hpp"
#include "core/error.hpp"

namespace pliant {
namespace {

std::vector<ResponseRow>& rows() {
  static std::vector<ResponseRow> all = {{"reflect", make_reflect}, {"impulse", make_impulse}};
  return all;
}

}  // namespace

std::span<const ResponseRow> responses() { return rows(); }

void add_response(const ResponseRow& row) { rows().push_back(row); }

const ResponseRow* find_response(const Named& name) {
  if (name.value == "none") return nullptr;
  const auto found = std::ranges::find(rows(), name.value, &ResponseRow::name);
  if (found != rows().end()) return &*found;
  std::vector<std::string_view> names = {"none"};
  std::ranges::transform(rows(), std::back_inserter(names), &ResponseRow::name);
  throw Error(name.where, fmt::format("there is no response \"{}\"", name.value),
              fmt::format("choose one of {}", fmt::join(names, ", ")));
}

}  // namespace pliant
