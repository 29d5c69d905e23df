// Writes results of the suite `stability` as text.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/stability/stability.hpp"

namespace pliant::bench {

/// Returns limits, maps with one letter a cell, drifts, errors and notes.
[[nodiscard]] std::string to_table(const StabilityResult& result);

/// Returns {suite, options{...}, interrupted, machine{...}, rows[{kind, ...}], notes[...]}. Kinds are limit, map, drift and
/// error.
[[nodiscard]] std::string to_json(const Machine& machine, const StabilityOptions& options, const StabilityResult& result);

}  // namespace pliant::bench
