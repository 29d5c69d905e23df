#include "mesh/obj.hpp"

#include <fmt/format.h>

#include <fstream>
#include <random>

#include "mesh/generators.hpp"
#include "mesh/load.hpp"
#include "support/expect_error.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string write_obj(const TriangleMesh& mesh) {
  std::string text = "# written by a test\n";
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

/// A mesh with random coordinates over many magnitudes. It uses every vertex.
TriangleMesh random_mesh(std::mt19937_64& random) {
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 8);
  TriangleMesh mesh;
  const auto number = [&] { return mantissa(random) * std::pow(10.0, exponent(random)); };
  const std::uint32_t count = std::uniform_int_distribution<std::uint32_t>(3, 60)(random);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.positions.emplace_back(number(), number(), number());
    mesh.triangles.push_back({i, (i + 1) % count, static_cast<std::uint32_t>(random() % count)});
  }
  return mesh;
}

struct BadFile {
  const char* text;
  const char* place;
  const char* reason;
};

const BadFile bad_files[] = {
    {"", "bad.obj:", "empty"},
    {" \r\n\t\n", "bad.obj:", "empty"},
    {"v nan 0 0\n", "bad.obj:1:", "not finite"},
    {"v 0 0 0\nv 1 inf 0\n", "bad.obj:2:", "not finite"},
    {"v 1e400 0 0\n", "bad.obj:1:", "not finite"},
    {"v 0 -1e400 0\n", "bad.obj:1:", "not finite"},
    {"v 0 0 2e9\n", "bad.obj:1:", "beyond"},
    {"v abc 0 0\n", "bad.obj:1:", "\"abc\" is no number"},
    {"v 1,5 0 0\n", "bad.obj:1:", "no number"},
    {"v 1.0x 0 0\n", "bad.obj:1:", "no number"},
    {"v 0 0\n", "bad.obj:1:", "2 coordinates"},
    {"v\n", "bad.obj:1:", "0 coordinates"},
    {"v 0 0 # 0\n", "bad.obj:1:", "2 coordinates"},
    {"v 0 0 0 red\n", "bad.obj:1:", "no number"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "bad.obj:4:", "index 0"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n", "bad.obj:5:", "names vertex 4"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "bad.obj:4:", "names vertex -4"},
    {"v 0 0 0\nf -1 -1 -2\nv 1 0 0\n", "bad.obj:2:", "names vertex -2"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "bad.obj:4:", "2 corners"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf\n", "bad.obj:4:", "0 corners"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3.5\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3//\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/1/1/1\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/0\n", "bad.obj:4:", "index 0"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3//-1\n", "bad.obj:4:", "normal -1"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", "bad.obj:4:", "no corner"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9999999999\n", "bad.obj:4:", "names vertex 9999999999"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n", "bad.obj:", "no triangles"},
    {"hello world\n", "bad.obj:", "no triangles"},
    {"v 0 0 0\nv 1 0 \\\n\n", "bad.obj:2:", "2 coordinates"},
    {"v 0 0 0\n\x7f"
     "ELF\x02\n",
     "bad.obj:2:", "byte 127"},
};

}  // namespace

TEST_CASE("a mesh written with 17 digits is read back bit for bit") {
  const unsigned seed = 20240817;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const TriangleMesh mesh = random_mesh(random);
    const TriangleMesh read = parse_obj(write_obj(mesh), "random").mesh;
    REQUIRE(read.positions == mesh.positions);
    REQUIRE(read.triangles == mesh.triangles);
  }
}

TEST_CASE("malformed OBJ text is an input error that names its line") {
  for (const BadFile& bad : bad_files) {
    CAPTURE(bad.text);
    const Error error = error_of([&] { return parse_obj(bad.text, "bad.obj"); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {bad.place, bad.reason, "; "});
  }
}

TEST_CASE("a zero byte makes a file binary") {
  const std::string text("v 0 0 0\nv 1\0 0 0\n", 17);
  check_says(error_of([&] { return parse_obj(text, "bad.obj"); }), {"bad.obj:2:", "byte 0"});
}

TEST_CASE("a missing file and a folder are input errors that name the path") {
  const Error missing = error_of([] { return load_obj("no/such.obj"); });
  CHECK(missing.kind() == ErrorKind::input);
  check_says(missing, {"no/such.obj", "can't be opened"});
  const Error folder = error_of([] { return load_obj(source_dir()); });
  CHECK(folder.kind() == ErrorKind::input);
  check_says(folder, {source_dir().c_str(), "is a folder"});
}

TEST_CASE("every form of a face's corner names the same triangle") {
  const std::string extras = three_vertices + "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/2/1", "f -3 -2 -1",
                           "f -3/-1/-1 2/1/1 3//1", "f\t1  2\t3  # a comment", "f 1 \\\n2 \\\n3", "f 1 2 \\\r\n3\r"}) {
    CAPTURE(face);
    const LoadedMesh loaded = parse_obj(extras + face, "face");
    CHECK(loaded.mesh.triangles == Triangles{{0, 1, 2}});
    CHECK(loaded.warnings.empty());
  }
}

TEST_CASE("line ends, a byte-order mark, weights, colours, signs and groups change nothing") {
  const std::string plain = three_vertices + "f 1 2 3\n";
  const LoadedMesh expected = parse_obj(plain, "plain");
  for (const char* text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3", "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3",
        "v 0 0 0 .1 .2 .3\nv 1 0 0 1 1 1\nv 0 1 0 0 0 1\nf 1 2 3", "v +0 0. .0\nv +1e0 0E-5 1e-400\nv 0 1.0 0\nf 1 2 3",
        "o thing\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng a b\nusemtl x\ns off\nf 1 2 3\nl 1 2\np 0\n"}) {
    CAPTURE(text);
    const LoadedMesh loaded = parse_obj(text, "variant");
    CHECK(loaded.mesh.positions == expected.mesh.positions);
    CHECK(loaded.mesh.triangles == expected.mesh.triangles);
  }
}

TEST_CASE("a face may stand before its vertices") {
  CHECK(parse_obj("f 1 2 3\n" + three_vertices, "order").mesh.triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("polygons are split as a fan from the first corner, whatever their shape") {
  const std::string quad = "v 0 0 0\nv 10 0 0\nv 11 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 3 4 1\n";
  CHECK(parse_obj(quad, "quad").mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}});
}

TEST_CASE("a polygon may have more corners than a byte counts") {
  std::string text, face = "f";
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("v {} {} 0\n", i, i * i);
    face += fmt::format(" {}", i + 1);
  }
  const TriangleMesh mesh = parse_obj(text + face, "polygon").mesh;
  REQUIRE(mesh.triangles.size() == 998);
  CHECK(mesh.triangles.back() == std::array<std::uint32_t, 3>{0, 998, 999});
}

TEST_CASE("vertices in no face are left out with a warning and the others keep their order") {
  const LoadedMesh loaded = parse_obj("v 9 9 9\n" + three_vertices + "v 8 8 8\nf 4 2 3\n", "unused");
  CHECK(loaded.mesh.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(loaded.mesh.triangles == Triangles{{2, 0, 1}});
  REQUIRE(loaded.warnings.size() == 1);
  CHECK_THAT(loaded.warnings[0], Catch::StartsWith("2 vertices"));
}

TEST_CASE("faces without area stay, with a warning that counts them") {
  const LoadedMesh loaded = parse_obj(three_vertices + "v 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\n", "flat");
  CHECK(loaded.mesh.triangles == Triangles{{0, 1, 2}, {0, 1, 3}, {0, 0, 1}});
  REQUIRE(loaded.warnings.size() == 1);
  CHECK_THAT(loaded.warnings[0], Catch::StartsWith("2 triangles"));
}

TEST_CASE("one flaw is told in the singular") {
  const LoadedMesh loaded = parse_obj(three_vertices + "v 2 0 0\nf 1 2 3\nf 1 1 2\n", "flat");
  CHECK(loaded.warnings == std::vector<std::string>{"1 vertex is in no face and left out", "1 triangle has no area"});
}

TEST_CASE("a mesh's description is a generator's or a path relative to the given folder") {
  CHECK(load_mesh("icosphere:0", "no/such/folder").mesh.positions.size() == 12);
  CHECK(load_mesh("bunny.obj", source_dir() + "/meshes").mesh.positions.size() == 1839);
  check_says(error_of([] { return load_mesh("sphere.obj", "no/such"); }), {"no/such/sphere.obj"});
}

TEST_CASE("the shipped meshes have the published counts and no warnings") {
  const LoadedMesh bunny = load_obj(source_dir() + "/meshes/bunny.obj");
  const LoadedMesh teapot = load_obj(source_dir() + "/meshes/teapot.obj");
  CHECK((bunny.mesh.positions.size() == 1839 && bunny.mesh.triangles.size() == 3674 && bunny.warnings.empty()));
  CHECK((teapot.mesh.positions.size() == 792 && teapot.mesh.triangles.size() == 992));
  CHECK(teapot.warnings == std::vector<std::string>{});
}

}  // namespace pliant
