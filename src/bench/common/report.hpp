// Writes results of the suites as text: tables for people, JSON for scripts.
#pragma once
#include <string>
#include <vector>

#include "bench/common/machine.hpp"
#include "bench/draw/draw.hpp"
#include "bench/forces/forces.hpp"
#include "bench/steps/steps.hpp"

namespace pliant::bench {

/// Returns two lines for the top of a table: the build, and the hardware.
[[nodiscard]] std::string to_text(const Machine& machine);
[[nodiscard]] std::string to_table(const ForcesResult& result);
[[nodiscard]] std::string to_table(const StepsResult& result);
[[nodiscard]] std::string to_table(const DrawResult& result);
/// Returns a sentence.
[[nodiscard]] std::string to_text(const FamilyCrossover& crossover);

/// Returns {suite, options{...}, interrupted, machine{version, commit, cpu, cpu_threads, gpu, driver, compiler, date}, rows[...],
/// notes[...]}. The suite `steps` also has {crossovers[...]}.
[[nodiscard]] std::string to_json(const Machine& machine, const ForcesOptions& options, const ForcesResult& result);
[[nodiscard]] std::string to_json(const Machine& machine, const StepsOptions& options, const StepsResult& result);
[[nodiscard]] std::string to_json(const Machine& machine, const DrawOptions& options, const DrawResult& result);

}  // namespace pliant::bench
