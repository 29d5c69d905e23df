// Writes results of the suite `draw` as text: a table for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/draw/draw.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const DrawResult& result);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const DrawOptions& options, const DrawResult& result);

}  // namespace pliant::bench
