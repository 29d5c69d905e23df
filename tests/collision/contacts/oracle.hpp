// Contacts by brute force, without trees: what the searches are tested against.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace pliant {

/// Returns all pairs of triangles of different bodies that touch according to `test`. They are indices into Model::triangles, the
/// lower first, in ascending order. `world_positions` [m] are those of the model's vertices. They have to be finite, without w.
/// The cost is the product of the triangle counts in the overlap of two bodies' boxes.
[[nodiscard]] std::vector<glm::uvec2> intersecting_pairs(const Model& model, std::span<const glm::vec4> world_positions,
                                                         TriangleTest test);

}  // namespace pliant
