// Checks what a response needs that keeps bodies apart: bodies that are apart where a run begins or goes on.
#pragma once
#include <string>
#include <vector>

#include "simulation/simulation.hpp"

namespace pliant {

/// Returns which bodies intersect, with the number of triangle pairs, or nothing if none do. Names at most eight.
[[nodiscard]] std::string told_overlap(Simulation& simulation, const Model& model);

/// Returns a text for each body whose contacts are lost in rounding: the margin of proofs that bodies stay apart is more than a
/// quarter of the gap that contacts keep. Such bodies stand where they touch, or tremble. `precision` is that of the device.
[[nodiscard]] std::vector<std::string> told_rounding(const Model& model, const State& state,
                                                     const CollisionDescription& collision, int precision);

/// Throws Error (input) that blames `place` if bodies intersect, stand in a ground, or are so near each other that no proof can
/// tell that they are apart, though the scene's response keeps them apart. It names two bodies, how deep they are in each other,
/// and a way out.
void expect_apart(Simulation& simulation, const Model& model, const CollisionDescription& collision, const std::string& place);

/// Does the same where a run goes on with other bodies or settings, but lets bodies be too near each other for proofs. Steps hold
/// such bodies still against each other.
void expect_still_apart(Simulation& simulation, const Model& model, const CollisionDescription& collision,
                        const std::string& place);

/// Throws Error (input) that blames `place` if bodies that have come near each other in a run at precision 64 are too near for
/// proofs at this simulation's precision, though the scene's response keeps them apart. It names two bodies.
void expect_provable(Simulation& simulation, const Model& model, const CollisionDescription& collision, const std::string& place);

}  // namespace pliant
