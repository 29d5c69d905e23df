// Reads Wavefront OBJ files strictly: whatever is malformed is an error that names its line.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

struct LoadedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;  // sentences without a full stop, such as "3 vertices are in no face and left out"
};

/// Largest |coordinate| that a file may hold [mesh units].
inline constexpr double max_coordinate = 1e9;

/// Reads positions and faces. Ignores all else in the file (normals, texture, groups, materials, lines, points).
/// - Polygons are split as a fan from the first corner.
/// - Vertices keep the file's order. Vertices in no face are left out with a warning.
/// - Faces without area stay with a warning.
/// Throws Error (input) that names the path and the line at fault.
[[nodiscard]] LoadedMesh load_obj(const std::filesystem::path& path);

/// Reads the same from text in memory. `name` stands for the path in errors.
[[nodiscard]] LoadedMesh parse_obj(std::string_view text, const std::string& name);

}  // namespace pliant
