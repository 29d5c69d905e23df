// JSON to read in tests. Files that include this do not see the library that reads the text, because it takes seconds to compile.
#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pliant::test {

/// A JSON value to read. Access throws if the value is of another kind, or lacks the key or index.
class ReadJson {
 public:
  /// Parses the text. Throws if it is no JSON.
  [[nodiscard]] static ReadJson parse(std::string_view text);

  // Values to compare with.
  ReadJson(bool value);
  ReadJson(double value);
  ReadJson(const char* text);
  ReadJson(const std::string& text);
  ReadJson(const std::vector<ReadJson>& elements);
  template <std::integral T>
  requires(!std::same_as<T, bool>) ReadJson(T value) : value_(whole(value)) {}

  /// Returns the member of an object, or the element of an array.
  [[nodiscard]] ReadJson operator[](std::string_view key) const;
  [[nodiscard]] ReadJson operator[](std::size_t index) const;
  [[nodiscard]] ReadJson back() const;
  [[nodiscard]] bool contains(std::string_view key) const;
  /// Returns the keys of an object in the order of the text.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Returns a copy of an object that lacks this member.
  [[nodiscard]] ReadJson without(std::string_view key) const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_number_unsigned() const;  // whole, and not below zero
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_string() const;
  /// Returns the value as bool, double, std::uint32_t, std::uint64_t or std::string. Converts numbers.
  template <class T>
  [[nodiscard]] T get() const;
  /// Returns the text in one line.
  [[nodiscard]] std::string text() const;

  /// Numbers are equal if their values are. Objects are equal if their members have the same order, too.
  friend bool operator==(const ReadJson& a, const ReadJson& b);
  /// Throws if either is no number.
  friend std::partial_ordering operator<=>(const ReadJson& a, const ReadJson& b);
  friend std::ostream& operator<<(std::ostream& out, const ReadJson& json);

  /// Goes over the elements of an array.
  struct Iterator {
    const ReadJson* array;
    std::size_t index;
    ReadJson operator*() const { return (*array)[index]; }
    Iterator& operator++() { return ++index, *this; }
    bool operator==(const Iterator&) const = default;
  };
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

 private:
  using Value = nlohmann::ordered_json;
  static std::shared_ptr<const Value> whole(std::int64_t value);
  static std::shared_ptr<const Value> whole(std::uint64_t value);
  template <std::integral T>
  static std::shared_ptr<const Value> whole(T value) {
    return whole(static_cast<std::conditional_t<std::signed_integral<T>, std::int64_t, std::uint64_t>>(value));
  }

  explicit ReadJson(std::shared_ptr<const Value> value) : value_(std::move(value)) {}
  [[nodiscard]] ReadJson part(const Value& value) const;

  std::shared_ptr<const Value> value_;  // shares the document that it is a part of
};

}  // namespace pliant::test
