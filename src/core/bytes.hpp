// Values as bytes, one after the other in the machine's own order, and back.
#pragma once
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace pliant {

template <class T>
void append_bytes(std::string& to, const T& value) {
  static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  to.append(bytes, sizeof(T));
}

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    append_bytes(bytes_, value);
  }
  /// With its length.
  void put_text(std::string_view text) {
    put(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class T>
  void put_optional(const std::optional<T>& value) {
    put(std::uint8_t{value.has_value()});
    if (value) put(*value);
  }

  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote, in the same order. Throws Error (input) where bytes are missing. `bytes` must outlive it.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  [[nodiscard]] T get() {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  [[nodiscard]] std::string_view get_text() { return take(get<std::uint64_t>()); }
  template <class T>
  [[nodiscard]] std::optional<T> get_optional() {
    if (get<std::uint8_t>() == 0) return std::nullopt;
    return get<T>();
  }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw Error(ErrorKind::input, "", "bytes are missing", "");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace pliant
