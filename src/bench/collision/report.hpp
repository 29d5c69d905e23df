// Writes results of the suite `collision` as text: a table for people, JSON for scripts.
#pragma once
#include <string>

#include "bench/collision/collision.hpp"
#include "bench/common/machine.hpp"

namespace pliant::bench {

[[nodiscard]] std::string to_table(const CollisionResult& result);
/// Returns {suite, options{...}, interrupted, machine{...}, rows[...], notes[...], contact_steps[...], passes{...}}.
/// `passes` has those of each of the contact_groups().
[[nodiscard]] std::string to_json(const Machine& machine, const CollisionOptions& options, const CollisionResult& result);

}  // namespace pliant::bench
