// What is drawn over bodies to show how they are simulated, as lines.
#pragma once
#include <span>
#include <vector>

#include "collision/tree.hpp"
#include "model/model.hpp"
#include "render/line_overlay.hpp"

namespace pliant::view {

using Lines = std::vector<render::LineEnd>;

/// The boxes of all trees' nodes at a level, the root's being 0, and of leaves above it. `positions` are the vertices' [m].
void add_boxes(Lines& lines, const Forest& forest, std::span<const glm::dvec3> positions, unsigned level);

/// A tenth of a second's way of each vertex.
void add_velocities(Lines& lines, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities);

/// A cross, so large as a tenth of the body, at each vertex that touched another body in `step` by its mark.
void add_contacts(Lines& lines, const Model& model, std::span<const glm::dvec3> positions, std::span<const std::uint32_t> marks,
                  std::uint64_t step);

}  // namespace pliant::view
