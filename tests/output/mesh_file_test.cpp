// Mesh files, read back.
#include "output/mesh_file.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "core/read_text.hpp"
#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {

using test::ScratchFolder;

TEST_CASE("a mesh in an OBJ file reads back bit for bit") {
  const ScratchFolder folder;
  const TriangleMesh mesh = generate_mesh("icosphere:2");
  write_mesh(folder.path / "new" / "sphere.OBJ", mesh);
  const LoadedMesh loaded = load_obj(folder.path / "new" / "sphere.OBJ");
  CHECK((loaded.mesh.positions == mesh.positions && loaded.mesh.triangles == mesh.triangles));
  CHECK(loaded.warnings.empty());
}

TEST_CASE("a mesh in a PLY file has its positions and triangles behind the header") {
  const ScratchFolder folder;
  const TriangleMesh mesh = generate_mesh("icosphere:1");
  write_mesh(folder.path / "sphere.ply", mesh);
  const std::string text = read_text(folder.path / "sphere.ply");
  CHECK_THAT(text, Catch::StartsWith("ply\nformat binary_little_endian 1.0\n"));
  CHECK_THAT(text, Catch::Contains("element vertex 42\n") && Catch::Contains("element face 80\n"));
  const std::string end = "end_header\n";
  const std::size_t first = text.find(end) + end.size();
  REQUIRE(text.size() == first + 42 * 3 * sizeof(double) + 80 * (1 + 3 * sizeof(std::int32_t)));
  CHECK(std::memcmp(text.data() + first, mesh.positions.data(), 42 * 3 * sizeof(double)) == 0);
  for (std::size_t t = 0; t < 80; ++t) {
    const char* face = text.data() + first + 42 * 3 * sizeof(double) + 13 * t;
    CHECK(face[0] == 3);
    CHECK(std::memcmp(face + 1, mesh.triangles[t].data(), 12) == 0);
  }
}

TEST_CASE("a mesh goes into an OBJ or a PLY file alone") {
  const ScratchFolder folder;
  for (const char* name : {"sphere", "sphere.stl", "sphere.obj.gz"}) {
    const Error error = error_of([&] { return write_mesh(folder.path / name, generate_mesh("icosphere:0")), 0; });
    CHECK(error.kind() == ErrorKind::command_line);
    check_says(error, {name, "end it in .obj or .ply"});
    check_says(error_of([&] { return expect_place_for_mesh(folder.path / name), 0; }), {name, ".ply"});
  }
  CHECK(std::filesystem::is_empty(folder.path));
}

}  // namespace pliant
