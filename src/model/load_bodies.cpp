#include "model/load_bodies.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "core/counted.hpp"
#include "core/error.hpp"
#include "mesh/load.hpp"
#include "mesh/weld.hpp"

namespace pliant {
namespace {

/// Welds before scaling. The scene gives the distance in metres.
void weld_as_described(const BodyDescription& body, LoadedMesh& loaded) {
  if (!body.weld || *body.weld == 0) return;
  WeldedMesh welded = weld(loaded.mesh, *body.weld / body.scale);
  if (welded.mesh.triangles.empty())
    throw Error(ErrorKind::input, "", fmt::format("welding at {} m leaves no triangles", *body.weld),
                "weld at a smaller distance");
  if (welded.dropped_triangle_count > 0)
    loaded.warnings.push_back("welding has collapsed and left out " +
                              counted(welded.dropped_triangle_count, "triangle", "triangles"));
  loaded.mesh = std::move(welded.mesh);
}

LoadedMesh load_one(const BodyDescription& body, const std::filesystem::path& folder) {
  try {
    LoadedMesh loaded = load_mesh(body.mesh, folder);
    weld_as_described(body, loaded);
    return loaded;
  } catch (const Error& error) {
    throw Error(body.mesh_where, error.what(), "");
  }
}

}  // namespace

std::vector<BodySetup> load_bodies(const SceneDescription& scene, std::vector<std::string>* warnings) {
  std::vector<BodySetup> setups;
  std::map<std::pair<std::string, double>, TriangleMesh> meshes;  // by what they are called, and how they are welded
  for (const BodyDescription& body : scene.bodies) {
    const auto [found, is_new] = meshes.try_emplace({body.mesh, body.weld.value_or(0) / body.scale});
    if (is_new) {
      LoadedMesh loaded = load_one(body, scene.file.parent_path());
      found->second = std::move(loaded.mesh);
      if (warnings != nullptr)
        for (const std::string& warning : loaded.warnings) warnings->push_back(fmt::format("{}: {}", body.name, warning));
    }
    setups.push_back({found->second, body});
  }
  return setups;
}

}  // namespace pliant
