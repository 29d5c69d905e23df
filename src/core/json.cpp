// Writes the text with nlohmann's JSON. No other file of the library includes it, because it takes seconds to compile.
#include "core/json.hpp"

#include <nlohmann/json.hpp>

#include "core/expect.hpp"

namespace pliant {
namespace {

using Written = nlohmann::ordered_json;

Written written(const Json& json);

template <class Simple>
Written written(const Simple& value) {
  return value;
}

Written written(const Json::Array& elements) {
  Written list = Written::array();
  for (const Json& element : elements) list.push_back(written(element));
  return list;
}

Written written(const Json::Object& members) {
  Written object = Written::object();
  for (const auto& [key, value] : members) object.emplace(key, written(value));
  return object;
}

Written written(const Json& json) {
  return std::visit([](const auto& value) { return written(value); }, json.value());
}

}  // namespace

Json::Json(std::nullptr_t) : value_(nullptr) {}
Json::Json(bool value) : value_(value) {}
Json::Json(double value) : value_(value) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(std::string_view text) : value_(std::string(text)) {}
Json::Json(std::initializer_list<Member> members) : value_(Object(members)) {}
Json::Json(Value value) : value_(std::move(value)) {}

Json Json::whole(std::int64_t value) { return Json(Value(value)); }
Json Json::whole(std::uint64_t value) { return Json(Value(value)); }
Json Json::array(std::initializer_list<Json> elements) { return Json(Value(Array(elements))); }
Json Json::object() { return Json(Value(Object())); }

void Json::add(std::string key, Json value) {
  PLIANT_EXPECT(std::holds_alternative<Object>(value_));
  std::get<Object>(value_).push_back({std::move(key), std::move(value)});
}

void Json::add(Json element) {
  PLIANT_EXPECT(std::holds_alternative<Array>(value_));
  std::get<Array>(value_).push_back(std::move(element));
}

std::string Json::text(std::optional<unsigned> indent) const {
  const int spaces = indent ? static_cast<int>(*indent) : -1;
  return written(*this).dump(spaces, ' ', false, Written::error_handler_t::replace);
}

}  // namespace pliant
