// Loads, welds and subdivides the meshes that a scene names.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "mesh/obj.hpp"
#include "model/model.hpp"

namespace pliant {

/// Meshes that a program has in memory, by what a scene calls them.
using GivenMeshes = std::map<std::string, TriangleMesh>;

/// Returns one setup for each body, in the scene's order. A mesh that is not given is generated or read. Paths are relative to
/// the scene file's folder. Adds warnings of each mesh, beginning with the name of the first body that has it, unless `warnings`
/// is null. Throws Error that blames the mesh's origin.
[[nodiscard]] std::vector<BodySetup> load_bodies(const SceneDescription& scene, std::vector<std::string>* warnings = nullptr,
                                                 const ReadProgress& progress = {}, const GivenMeshes& given = {});

}  // namespace pliant
