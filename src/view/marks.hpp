// What is drawn over bodies to show how they are simulated, as lines.
#pragma once
#include <span>
#include <vector>

#include "collision/trees/tree.hpp"
#include "model/model.hpp"
#include "render/line_overlay.hpp"

namespace pliant::view {

using Lines = std::vector<render::LineEnd>;

/// The boxes of all trees' nodes at a level, the root's being 0, and of leaves above it. `positions` are the vertices' [m].
void add_boxes(Lines& lines, const Forest& forest, std::span<const glm::dvec3> positions, unsigned level);

/// A tenth of a second's way of each vertex.
void add_velocities(Lines& lines, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities);

/// A cross, a tenth of the body's radius wide, at each of the vertices.
void add_contacts(Lines& lines, const Model& model, std::span<const glm::dvec3> positions,
                  std::span<const std::uint32_t> touching);

}  // namespace pliant::view
