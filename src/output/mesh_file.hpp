// Writes a mesh for other programs to open, or for pliant to load again.
#pragma once
#include <filesystem>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Throws Error (command_line) unless the path's extension is one that write_mesh knows and a file can be written there.
void expect_place_for_mesh(const std::filesystem::path& path);

/// Writes binary PLY for ".ply" and Wavefront OBJ for ".obj". Positions keep every bit in both. The file appears as a whole.
/// Throws Error (command_line) as expect_place_for_mesh() does.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace pliant
