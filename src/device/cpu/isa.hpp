// The instruction sets for which pliant has code of its own, of which this machine has some.
#pragma once
#include <span>
#include <string_view>
#include <vector>

namespace pliant::cpu {

enum class Isa { portable, avx2, avx512 };

/// The environment variable that names the fastest instruction set to use.
inline constexpr const char* isa_variable = "PLIANT_ISA";

/// Returns the instruction sets that this machine has and PLIANT_ISA allows, the fastest last. Reads the variable once. Throws
/// Error (device) if the machine does not have what the variable names.
[[nodiscard]] std::span<const Isa> available_isas();
/// Returns the first of `isas`, up to the one of that name. Throws Error (device) if none has it.
[[nodiscard]] std::vector<Isa> isas_up_to(std::string_view most, std::span<const Isa> isas);
[[nodiscard]] std::string_view name_of(Isa isa);

}  // namespace pliant::cpu
