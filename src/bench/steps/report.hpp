// Writes results of the suite `steps` as text: a table for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/steps/steps.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const StepsResult& result);
/// Returns a sentence.
[[nodiscard]] std::string to_text(const FamilyCrossover& crossover);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...],
/// crossovers[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const StepsOptions& options, const StepsResult& result);

}  // namespace pliant::bench
