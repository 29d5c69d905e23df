#include "app/mesh_command.hpp"

#include <iostream>

#include "core/error.hpp"
#include "mesh/load.hpp"
#include "mesh/report.hpp"
#include "output/mesh_file.hpp"
#include "run/reading_line.hpp"

namespace pliant::app {
namespace {

LoadedMesh load_with_line(const std::string& mesh) {
  ReadingLine line(bytes_of_mesh(mesh, "."));
  return load_mesh(mesh, ".", line.progress());
}

TriangleMesh subdivide_as_asked(const TriangleMesh& mesh, const MeshOptions& options) {
  try {
    return subdivide(mesh, options.subdivide, options.subdivision);
  } catch (const Error& error) {
    throw error.within(ErrorKind::command_line, "--subdivide");
  }
}

}  // namespace

void show_mesh(const MeshOptions& options) {
  if (!options.out.empty()) expect_place_for_mesh(options.out);
  LoadedMesh loaded = load_with_line(options.mesh);
  for (const std::string& warning : loaded.warnings) std::cerr << "pliant: warning: " << warning << '\n';
  if (options.subdivide > 0) loaded.mesh = subdivide_as_asked(loaded.mesh, options);
  if (!options.out.empty()) write_mesh(options.out, loaded.mesh);
  const MeshReport report = report_mesh(loaded.mesh);
  std::cout << (options.json ? to_json(report) : to_text(report));
}

}  // namespace pliant::app
