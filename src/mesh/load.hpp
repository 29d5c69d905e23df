// Makes a mesh from what a scene file or a command line calls it.
#pragma once
#include <filesystem>
#include <string_view>

#include "mesh/obj.hpp"

namespace pliant {

/// Generates the mesh if the description is "generator:argument". Otherwise loads the OBJ file at that path, relative to
/// `base_folder`. Throws Error (input).
[[nodiscard]] LoadedMesh load_mesh(std::string_view description, const std::filesystem::path& base_folder,
                                   const ReadProgress& progress = {});

}  // namespace pliant
