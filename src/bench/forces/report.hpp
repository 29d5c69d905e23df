// Writes results of the suite `forces` as text: a table for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/forces/forces.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const ForcesResult& result);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const ForcesOptions& options, const ForcesResult& result);

}  // namespace pliant::bench
