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
  static std::vector<ResponseRow> all = {{}, reflect_row(), impulse_row()};  // first "none"
  return all;
}

void expect_immovable_allowed(const SceneDescription& scene, const ResponseRow& row) {
  if (row.allows_immovable) return;
  const auto fail_at = [&](const Origin& where, const char* what) {
    throw Error(where, fmt::format("{} with the response \"{}\"", what, row.name),
                "write response = \"impulse\" in [collision], which is the default");
  };
  if (!scene.grounds.empty()) fail_at(scene.grounds.front().where, "bodies would fall through a ground");
  for (const BodyDescription& body : scene.bodies)
    if (body.kind != BodyKind::soft)
      fail_at(body.kind_where, body.kind == BodyKind::scripted ? "a body can't be scripted" : "a body can't be static");
}

void expect_self_contact_allowed(const SceneDescription& scene, const ResponseRow& row) {
  if (row.keeps_apart) return;
  for (const BodyDescription& body : scene.bodies)
    if (body.self_contact)
      throw Error(body.self_contact_where, fmt::format("a body does not meet itself with the response \"{}\"", row.name),
                  "remove self_contact, or write response = \"impulse\" in [collision], which is the default");
}

void expect_search_allowed(const CollisionDescription& collision, const ResponseRow& row) {
  if (row.allows_brute_force || collision.search != ContactSearch::brute_force) return;
  throw Error(collision.search_where, fmt::format("the response \"{}\" finds pairs by trees alone", row.name),
              "remove search = \"brute_force\", or write response = \"reflect\"");
}

}  // namespace

std::span<const ResponseRow> responses() { return std::span(rows()).subspan(1); }

void add_response(const ResponseRow& row) { rows().push_back(row); }

const ResponseRow& find_response(const Named& name) {
  const auto found = std::ranges::find(rows(), name.value, &ResponseRow::name);
  if (found != rows().end()) return *found;
  std::vector<std::string_view> names;
  std::ranges::transform(rows(), std::back_inserter(names), &ResponseRow::name);
  throw Error(name.where, fmt::format("there is no response \"{}\"", name.value),
              fmt::format("choose one of {}", fmt::join(names, ", ")));
}

const ResponseRow& response_of(const SceneDescription& scene) {
  const ResponseRow& row = find_response(scene.collision.response);
  expect_immovable_allowed(scene, row);
  expect_self_contact_allowed(scene, row);
  expect_search_allowed(scene.collision, row);
  return row;
}

double elasticity_of(const CollisionDescription& collision) {
  return collision.elasticity.value_or(find_response(collision.response).elasticity);
}

}  // namespace pliant
