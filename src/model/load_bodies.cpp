#include "model/load_bodies.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>
#include <utility>

#include "core/counted.hpp"
#include "core/error.hpp"
#include "mesh/load.hpp"
#include "mesh/subdivide.hpp"
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

/// Subdivides after welding, so that triangles share vertices along seams, too.
void subdivide_as_described(const BodyDescription& body, TriangleMesh& mesh) {
  if (body.subdivide == 0) return;
  try {
    mesh = subdivide(mesh, body.subdivide, body.subdivision);
  } catch (const Error& error) {
    throw error.within(body.subdivide_where);
  }
}

// Where meshes come from.
struct MeshSource {
  std::filesystem::path folder;
  const ReadProgress& progress;
  const GivenMeshes& given;
};

LoadedMesh find_mesh(const std::string& name, const MeshSource& source) {
  const auto found = source.given.find(name);
  if (found != source.given.end()) return {.mesh = found->second, .warnings = {}};
  return load_mesh(name, source.folder, source.progress);
}

LoadedMesh load_welded(const BodyDescription& body, const MeshSource& source) {
  try {
    LoadedMesh loaded = find_mesh(body.mesh, source);
    weld_as_described(body, loaded);
    return loaded;
  } catch (const Error& error) {
    throw error.within(body.mesh_where);
  }
}

LoadedMesh load_one(const BodyDescription& body, const MeshSource& source) {
  LoadedMesh loaded = load_welded(body, source);
  subdivide_as_described(body, loaded.mesh);
  return loaded;
}

}  // namespace

std::vector<BodySetup> load_bodies(const SceneDescription& scene, std::vector<std::string>* warnings,
                                   const ReadProgress& progress, const GivenMeshes& given) {
  const MeshSource source{scene.file.parent_path(), progress, given};
  std::vector<BodySetup> setups;
  std::map<std::tuple<std::string, double, unsigned, Subdivision>, TriangleMesh> meshes;  // by what makes them what they are
  for (const BodyDescription& body : scene.bodies) {
    const auto [found, is_new] =
        meshes.try_emplace({body.mesh, body.weld.value_or(0) / body.scale, body.subdivide, body.subdivision});
    if (is_new) {
      LoadedMesh loaded = load_one(body, source);
      found->second = std::move(loaded.mesh);
      if (warnings != nullptr)
        for (const std::string& warning : loaded.warnings) warnings->push_back(fmt::format("{}: {}", body.name, warning));
    }
    setups.push_back({found->second, body});
  }
  return setups;
}

}  // namespace pliant
