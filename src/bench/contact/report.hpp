// Writes results of the suite `contact` as text.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/contact/contact.hpp"

namespace pliant::bench {

/// Returns a table for each kind of row, then notes.
[[nodiscard]] std::string to_table(const ContactResult& result);

/// Returns {suite, options{...}, interrupted, machine{...}, rows[{kind, ...}], notes[...]}. Kinds are apart, impact, rest and
/// cost.
[[nodiscard]] std::string to_json(const Machine& machine, const ContactOptions& options, const ContactResult& result);

}  // namespace pliant::bench
