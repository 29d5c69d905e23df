#include "device/cpu/isa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace pliant::cpu {
namespace {

std::vector<Isa> find_isas() {
  std::vector<Isa> isas{Isa::portable};
#ifdef PLIANT_X86_TILES
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return isas;
  isas.push_back(Isa::avx2);
  if (__builtin_cpu_supports("avx512f")) isas.push_back(Isa::avx512);
#endif
  return isas;
}

std::vector<Isa> find_allowed_isas() {
  const char* const most = std::getenv(isa_variable);
  return most == nullptr || *most == '\0' ? find_isas() : isas_up_to(most, find_isas());
}

}  // namespace

std::span<const Isa> available_isas() {
  static const std::vector<Isa> isas = find_allowed_isas();
  return isas;
}

std::vector<Isa> isas_up_to(std::string_view most, std::span<const Isa> isas) {
  const auto place = std::ranges::find(isas, most, name_of);
  if (place != isas.end()) return {isas.begin(), place + 1};
  std::string names;
  for (const Isa isa : isas) names += (names.empty() ? "" : ", ") + std::string(name_of(isa));
  throw Error(ErrorKind::device, isa_variable, fmt::format("this machine has no instruction set \"{}\"", most),
              fmt::format("unset the variable, or set it to one of {}", names));
}

std::string_view name_of(Isa isa) {
  constexpr std::array<std::string_view, 3> names{"portable", "avx2", "avx512"};
  return names[static_cast<std::size_t>(isa)];
}

}  // namespace pliant::cpu
