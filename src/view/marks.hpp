// Makes the lines that are drawn over bodies to show how they are simulated.
#pragma once
#include <span>
#include <vector>

#include "collision/trees/tree.hpp"
#include "model/model.hpp"
#include "render/contact_marks.hpp"

namespace pliant::view {

using render::Lines;

/// Adds the boxes of all trees' nodes at a level, and of leaves above it. The root's level is 0. `positions` are the vertices'
/// [m].
void add_boxes(Lines& lines, const Forest& forest, std::span<const glm::dvec3> positions, unsigned level);

/// Adds a line from each vertex to where its velocity takes it in a tenth of a second.
void add_velocities(Lines& lines, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities);

}  // namespace pliant::view
