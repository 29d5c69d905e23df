// Reads Wavefront OBJ files strictly: whatever is malformed is an error that names its line.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

struct LoadedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;  // sentences without a full stop, such as "3 vertices are in no face and left out"
};

/// Is told how many more bytes of a file have been read. Threads may call it at the same time.
using ReadProgress = std::function<void(std::uintmax_t bytes)>;

/// Largest |coordinate| that a file may hold [mesh units].
inline constexpr double max_coordinate = 1e9;

/// Reads positions and faces. Ignores all else in the file (normals, texture, groups, materials, lines, points).
/// - Polygons are split as a fan from the first corner.
/// - Vertices keep the file's order. Vertices in no face are left out with a warning.
/// - Faces without area stay with a warning.
/// `progress` is told of all bytes of a plain file, MB by MB. Of a file with a line that is not plain it may be told of some.
/// Throws Error (input) that names the path and the line at fault.
[[nodiscard]] LoadedMesh load_obj(const std::filesystem::path& path, const ReadProgress& progress = {});

/// Reads the same from text in memory. `name` stands for the path in errors.
[[nodiscard]] LoadedMesh parse_obj(std::string_view text, const std::string& name, const ReadProgress& progress = {});

}  // namespace pliant
