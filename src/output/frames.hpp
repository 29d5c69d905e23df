// Writes one file per frame with all bodies, for other programs to open.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>

#include "model/model.hpp"

namespace pliant {

enum class FrameFormat { none, png, obj, ply, vtk };

/// Returns a path such as `folder`/frame_0012.obj. ParaView and Blender take such files for one series. Expects a format other
/// than none.
[[nodiscard]] std::filesystem::path frame_path(const std::filesystem::path& folder, int index, FrameFormat format);

// The functions below take positions [m] and velocities [m/s] in the world, one a vertex of the model. A file appears as a whole,
// so a killed program leaves no half of one. They throw Error (command_line) if the file can't be written.

/// Writes Wavefront OBJ with 12 digits and one object a body.
void write_obj(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions);

/// Writes binary PLY. Each vertex has its position, its velocity, and its body's index and colour (sRGB).
void write_ply(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities);

/// Writes VTK legacy polydata as text with 12 digits. It has the point data `velocity` and `body`.
void write_vtk(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities);

}  // namespace pliant
