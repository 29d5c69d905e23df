// Writes results of the suite `drops` as text: a table for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/drops/drops.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const DropsResult& result);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const DropsOptions& options, const DropsResult& result);

}  // namespace pliant::bench
