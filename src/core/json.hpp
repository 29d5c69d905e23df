// JSON values to write as text. Files that include this do not see the library that writes the text.
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pliant {

/// A JSON value. An object keeps its members in the order in which they came.
class Json {
 public:
  struct Member;
  using Array = std::vector<Json>;
  using Object = std::vector<Member>;
  using Value = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;

  Json(std::nullptr_t = nullptr);
  Json(bool value);
  Json(double value);  // null if it is not finite
  Json(const char* text);
  Json(std::string text);
  Json(std::string_view text);
  /// Makes an object.
  Json(std::initializer_list<Member> members);
  template <std::integral T>
  requires(!std::same_as<T, bool>) Json(T value) : Json(whole(value)) {}
  /// Makes null if there is no value.
  template <class T>
  Json(const std::optional<T>& value) : Json(value ? Json(*value) : Json()) {}
  /// Makes an array.
  template <class T>
  Json(const std::vector<T>& values);

  [[nodiscard]] static Json array(std::initializer_list<Json> elements);
  [[nodiscard]] static Json object();

  /// Appends a member. Expects an object without this key.
  void add(std::string key, Json value);
  /// Appends an element. Expects an array.
  void add(Json element);

  [[nodiscard]] const Value& value() const { return value_; }
  /// Returns the text in one line. With `indent`, each value has a line of its own, indented by that many spaces per level. Bytes
  /// that are not UTF-8 are replaced.
  [[nodiscard]] std::string text(std::optional<unsigned> indent = {}) const;

 private:
  static Json whole(std::int64_t value);
  static Json whole(std::uint64_t value);
  template <std::integral T>
  static Json whole(T value) {
    return whole(static_cast<std::conditional_t<std::signed_integral<T>, std::int64_t, std::uint64_t>>(value));
  }
  explicit Json(Value value);

  Value value_;
};

struct Json::Member {
  std::string key;
  Json value;
};

template <class T>
Json::Json(const std::vector<T>& values) : Json(array({})) {
  for (const T& value : values) add(Json(value));
}

/// Returns an array of what `json_of` makes of each item.
template <class Items, class ToJson>
[[nodiscard]] Json list_of(const Items& items, const ToJson& json_of) {
  Json list = Json::array({});
  for (const auto& item : items) list.add(json_of(item));
  return list;
}

}  // namespace pliant
