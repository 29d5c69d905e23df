// The bytes hold the precision, then each array with its name and length.
#include "state/carried_state.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace pliant {
namespace {

template <class From, class To>
std::string rounded(std::string_view bytes) {
  std::vector<From> numbers(bytes.size() / sizeof(From));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(From));
  ByteWriter result;
  for (const From number : numbers) result.put(static_cast<To>(number));
  return result.take();
}

std::string in_precision(std::string_view bytes, std::uint32_t before, int now) {
  if (before == static_cast<std::uint32_t>(now)) return std::string(bytes);
  return now == 64 ? rounded<float, double>(bytes) : rounded<double, float>(bytes);
}

}  // namespace

void write_arrays(Device& device, std::span<const CarriedArray> arrays, ByteWriter& to) {
  to.put(static_cast<std::uint32_t>(device.precision()));
  std::string bytes;
  for (const CarriedArray& array : arrays) {
    bytes.resize(array.byte_count);
    device.read(array.buffer, array.first_byte, std::as_writable_bytes(std::span(bytes)));
    to.put(array.name);
    to.put(bytes);
  }
}

void read_arrays(Device& device, std::span<const CarriedArray> arrays, ByteReader& from) {
  const auto precision = from.get<std::uint32_t>();
  for (const CarriedArray& array : arrays) {
    const auto name = from.get<std::string>();
    auto bytes = from.get<std::string>();
    if (array.is_real) bytes = in_precision(bytes, precision, device.precision());
    if (name != array.name || bytes.size() != array.byte_count)
      throw Error(ErrorKind::input, "", "its state belongs to other bodies or to another method than its scene", "");
    device.write(array.buffer, array.first_byte, std::as_bytes(std::span(bytes)));
  }
}

}  // namespace pliant
