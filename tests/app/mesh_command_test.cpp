// `pliant mesh`, as a shell runs it.
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "mesh/obj.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {

using test::ScratchFolder;

TEST_CASE("pliant mesh subdivides a file or a generator's mesh, writes it and reports it") {
  const ScratchFolder folder;
  const std::string out = (folder.path / "fine.obj").string();
  const ProgramResult fine = run_program("mesh icosphere:1 --subdivide 2 --out " + out);
  CHECK(fine.exit_code == 0);
  CHECK_THAT(fine.output, Catch::Contains("vertices              642\n"));
  CHECK(load_obj(out).mesh.triangles.size() == 1280);
  const std::string smooth = (folder.path / "smooth.obj").string();
  const ProgramResult again = run_program("mesh " + out + " --json --subdivide 1 --subdivision loop --out " + smooth);
  CHECK(again.exit_code == 0);
  CHECK_THAT(again.output, Catch::Contains("\"vertices\": 2562"));
  CHECK(load_obj(smooth).mesh.positions[0] != load_obj(out).mesh.positions[0]);
}

TEST_CASE("pliant mesh refuses subdivisions that are too many, and places that hold no mesh") {
  const ScratchFolder folder;
  for (const auto& [arguments, reason] :
       std::initializer_list<std::pair<const char*, const char*>>{{"--subdivide 15", "subdivide 13 times at most"},
                                                                  {"--subdivide 16", "16 is above 15"},
                                                                  {"--subdivide 1.5", "no whole number"},
                                                                  {"--subdivision loop", "--subdivide"},
                                                                  {"--subdivide 1 --subdivision butterfly", "butterfly"},
                                                                  {"--out sphere.stl", "end it in .obj or .ply"},
                                                                  {"--out ''", "is empty"}}) {
    CAPTURE(arguments);
    const ProgramResult result = run_program(std::string("mesh icosphere:0 ") + arguments);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains(reason));
  }
}

#ifndef __SANITIZE_ADDRESS__  // its own memory is beyond any limit
#ifndef __SANITIZE_THREAD__
TEST_CASE("a mesh too large for the memory is refused before it is made") {
  const ProgramResult result = run_program("mesh cube:2 --subdivide 11", "ulimit -v 4000000; ");  // [KiB]
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("--subdivide: 11 subdivisions make 100663298 vertices and 201326592 triangles") &&
                                Catch::Contains("no 9.7 GB of memory; subdivide fewer times"));
}
#endif
#endif

TEST_CASE("pliant mesh says on a terminal that it reads a large file, and nowhere else") {
  const ScratchFolder folder;
  const std::string file = (folder.path / "large.obj").string();
  std::ofstream(file) << std::string(21'000'000, '#') << "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  ProgramInTerminal terminal({"mesh", file});
  CHECK_FALSE(terminal.has_shown_progress(1));  // no bar: it reads on to the end
  CHECK_THAT(terminal.end_by(SIGTERM).output, Catch::Contains("reading 21 MB of meshes") && Catch::Contains("triangles "));
  CHECK_THAT(run_program("mesh " + file).output, !Catch::Contains("reading"));
}

}  // namespace pliant
