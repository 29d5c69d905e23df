// Looks for bodies that begin nearer to each other, or to a ground, than the gap that contacts by impulses keep, and for bodies
// that begin inside others.
#pragma once
#include <string>
#include <vector>

#include "model/model.hpp"

namespace pliant {

/// Returns a text for each two bodies, and for each body and ground, that begin nearer than 0.99 of their gap. Contacts push them
/// apart in the first step, which adds energy. Returns one, too, for each body that another one encloses, because contacts keep
/// it there. Names eight at most, and counts the rest. Expects bodies that are apart.
[[nodiscard]] std::vector<std::string> told_near_starts(const Model& model, const State& state,
                                                        const CollisionDescription& collision);

}  // namespace pliant
