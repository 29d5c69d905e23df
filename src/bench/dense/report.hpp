// Writes results of the suite `dense` as text: tables for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/dense/dense.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const DenseResult& result);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...], forces[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const DenseOptions& options, const DenseResult& result);

}  // namespace pliant::bench
