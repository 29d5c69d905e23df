// One file per frame with all bodies, for other programs to open.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>

#include "model/model.hpp"

namespace pliant {

enum class FrameFormat { none, png, obj, ply, vtk };

/// `folder`/frame_0012.obj: what ParaView and Blender take for one series. Expects a format other than none.
[[nodiscard]] std::filesystem::path frame_path(const std::filesystem::path& folder, int index, FrameFormat format);

// Positions [m] and velocities [m/s] are in the world, one a vertex of the model. A file appears as a whole, so that a program
// that is killed leaves no half of one. All throw Error (command_line) when it can't be written.

/// Wavefront OBJ: an object a body, 12 digits.
void write_obj(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions);

/// PLY, binary: positions, velocities, the body's index and its colour (sRGB).
void write_ply(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities);

/// VTK legacy polydata in text, 12 digits: with point data `velocity` and `body`.
void write_vtk(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities);

}  // namespace pliant
