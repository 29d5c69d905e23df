// Writes results of the suite `precision` as text.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/precision/precision.hpp"

namespace pliant::bench {

/// Returns a table for each case and then the contest. A case's table has the milliseconds to every asked error by method, on one
/// thread in fp64, and then the cheapest of all.
[[nodiscard]] std::string to_table(const PrecisionResult& result);

/// Returns {suite, options{...}, interrupted, machine{...}, versions{...}, cases[...], rows[...], cheapest[...], contest[...],
/// evaluation_costs[...], curves[...], notes[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const PrecisionOptions& options, const PrecisionResult& result);

}  // namespace pliant::bench
