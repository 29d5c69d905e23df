// Makes the lines that show contacts over a picture.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "render/line_overlay.hpp"
#include "simulation/simulation.hpp"

namespace pliant::render {

using Lines = std::vector<LineEnd>;

/// Adds a line between two places [m]. `color` is sRGB and opacity.
void add_line(Lines& lines, const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);

/// Adds a cross at each touching vertex. It is a tenth of the body's radius wide.
void add_touching(Lines& lines, const Model& model, std::span<const glm::dvec3> positions,
                  std::span<const std::uint32_t> touching);

/// Adds a small cross at each contact, and a line for each soft body along the impulse that it gets there. The line of the
/// largest impulse is as long as half the smallest radius of a soft body. The others are in proportion.
void add_impulses(Lines& lines, const Model& model, std::span<const glm::dvec3> positions,
                  std::span<const ContactImpulse> contacts);

/// Adds the contacts of the simulation's latest step: impulses where the response gives them, else touching vertices. Waits for
/// the step. `positions` are those after it [m].
void add_contacts(Lines& lines, Simulation& simulation, const Model& model, std::span<const glm::dvec3> positions);

}  // namespace pliant::render
