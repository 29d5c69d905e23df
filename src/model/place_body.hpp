// Puts the vertices of a body where a program wants them, with the velocities that it wants.
#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "model/model.hpp"

namespace pliant {

/// Puts the vertices of a body at places in the world [m], one for each. The body's frame goes along, with the rotation that is
/// nearest to the rest shape. Velocities in the world stay as they are, but for rounding. `gravity` is that of the world [m/s^2].
void place_body(State& state, const Model& model, std::size_t body, std::span<const glm::dvec3> positions,
                const glm::dvec3& gravity);

/// Gives the vertices of a body velocities in the world [m/s], one for each.
void set_velocities(State& state, const Model& model, std::size_t body, std::span<const glm::dvec3> velocities);

}  // namespace pliant
