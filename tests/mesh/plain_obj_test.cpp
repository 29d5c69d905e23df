// The fast reader beside the strict one, which is the oracle.
#include "mesh/plain_obj.hpp"

#include <atomic>
#include <cstring>
#include <random>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "mesh/compact.hpp"
#include "mesh/obj.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

/// Joins a comment with an empty line behind it. Text behind that is as it was, but no longer plain.
const std::string not_plain = "# \\\n\n";

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(glm::dvec3)) == 0;
}

/// Returns nothing if the text is an error.
std::optional<LoadedMesh> parsed(const std::string& text) {
  try {
    return parse_obj(text, "text");
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Expects the same of the text as of text that only the strict reader takes.
void check_against_strict(const std::string& text) {
  CAPTURE(text);
  const std::optional<LoadedMesh> loaded = parsed(text), strict = parsed(not_plain + text);
  REQUIRE(loaded.has_value() == strict.has_value());
  if (!loaded) return;
  REQUIRE(same_bits(loaded->mesh, strict->mesh));
  REQUIRE(loaded->warnings == strict->warnings);
}

const char* const plain_texts[] = {
    "f 1 2 3",
    "f 1 2 3 4\n",
    "f 1 2 3 4 \t\n",
    "f 1/1 2/2 3/1\r\nf 1//1 2//1 3//1\r\nf 1/1/1 2/2/1 3/2/1\r\n",
    "f 1/7 2/2147483647 3/1\n",
    "  f\t1  2\t3# a comment",
    "# a comment\nf 01 002 3\n#\n",
    "f 1 1 2\nf 3 4 1\n",
    "v 1e-3 -1.5E+2 .5 1 0.5 0.25 # and a colour\nv 5. -0 1e8\nf 5 6 1\n",
    "v 0.1 4.9e-324 123456789.123456789\nf 5 2 1\nf 4 3 1\n",
    "\n\n\t\n o thing\nmtllib none.mtl\nvt 0 0\nvn x y z\nvp 1\ng a b\nusemtl \\x\ns off\nl 1 2\np 0\nfoo\nf 2 1 "
    "3\nverse\nface\n",
};

const char* const other_texts[] = {
    "f -1 -2 -3\n",
    "v +1 0 0\nf 1 2 3\n",
    "f 1 2 \\\n3\n",
    "# this goes on \\\nf 1 2 3\nf 1 2 3\n",
    "# this goes on \\\r\nf 1 2 3\nf 1 2 3\n",
    "f 1 2 3\nusemtl x\\",
    "f 1 2 3\rf 1 3 4\n",
    "# a\rb\r\nf 1 2 3\r\n",
    "# \x01\nf 1 2 3\n",
    "f 1 2 3\n# \x7f\n",
    "f 1 2\n",
    "f 1 2 3\nf",
    "f 1 2 3\nv",
    "f 0 1 2\n",
    "f 1 2 5\n",
    "f 1 2 3/\n",
    "f 1 2 3//\n",
    "f 1 2 3/1/1/1\n",
    "f 1 2 3/-1\n",
    "f 1 2 3x\n",
    "f 1 2 2147483648\n",
    "f 1 2 99999999999999999999\n",
    "f\nf 1 2 3\n",
    "v\nf 1 2 3\n",
    "v 1 2\nf 1 2 3\n",
    "v 1 2 3 x\nf 1 2 3\n",
    "v 1 2 nan\nf 1 2 3\n",
    "v 1 2 inf\nf 1 2 3\n",
    "v 1 2 1.1e9\nf 1 2 3\n",
    "v 1 2 1e400\nf 1 2 3\n",
    "v 1 2 1e-400\nf 1 2 3\n",
    "v 1,5 2 3\nf 1 2 3\n",
    "l 1 2\n",
    "",
};

}  // namespace

TEST_CASE("plain OBJ text is read at once, as the strict reader does") {
  for (const char* text : plain_texts) {
    CAPTURE(text);
    CHECK(read_plain_obj(square + text, 1));
    CHECK(read_plain_obj("\xEF\xBB\xBF" + square + text, 1));
    CHECK_FALSE(read_plain_obj(not_plain + square + text, 1));
    check_against_strict(square + text);
    check_against_strict(text + ("\n" + square));
  }
}

TEST_CASE("OBJ text that is not plain is left to the strict reader") {
  for (const char* text : other_texts) {
    CAPTURE(text);
    CHECK_FALSE(read_plain_obj(square + text, 1));
    check_against_strict(square + text);
  }
}

TEST_CASE("a mesh does not depend on the number of parts in which its text is read") {
  for (const char* text : plain_texts) {
    const std::string all = square + text;
    const TriangleMesh whole = *read_plain_obj(all, 1);
    for (std::size_t parts = 2; parts < 20; ++parts) {
      const std::optional<TriangleMesh> mesh = read_plain_obj(all, parts);
      CAPTURE(all, parts);
      REQUIRE(mesh);
      CHECK(same_bits(*mesh, whole));
    }
  }
}

TEST_CASE("whoever asks is told of every byte that is read, on whatever thread, and of nothing behind a line that is not plain") {
  const std::string mark = "\xEF\xBB\xBF";
  std::string text;
  for (int k = 0; k < 100'000; ++k) text += "v 0.25 0.5 1.125 # some vertex\n";
  text += "f 1 2 3\n";
  for (const std::size_t parts : {1u, 3u}) {
    std::atomic<std::uintmax_t> told = 0, calls = 0;
    const ReadProgress progress = [&](std::uintmax_t bytes) {
      told += bytes;
      ++calls;
    };
    REQUIRE(read_plain_obj(mark + text, parts, progress));
    CHECK(told == mark.size() + text.size());
    CHECK(calls >= text.size() >> 20);
  }
  std::uintmax_t told = 0;
  CHECK_FALSE(read_plain_obj("v 1 2\n" + text, 1, [&](std::uintmax_t bytes) { told += bytes; }));
  CHECK(told == 0);
}

TEST_CASE("the shipped meshes are plain, in any number of parts") {
  for (const char* name : {"bunny.obj", "teapot.obj", "ramp.obj"}) {
    const std::string text = read_text(source_dir() + "/meshes/" + name);
    const TriangleMesh strict = parse_obj(not_plain + text, name).mesh;
    for (const std::size_t parts : {1, 2, 3, 16}) {
      std::optional<TriangleMesh> mesh = read_plain_obj(text, parts);
      REQUIRE(mesh);
      remove_unused_vertices(*mesh);
      CHECK(same_bits(*mesh, strict));
    }
  }
}

TEST_CASE("text with any characters changed is read as by the strict reader, or is an error for both") {
  const unsigned seed = 20261129;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const std::string start = square + "vt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\n# c\nf 1//1 3//1 4//1\nf 4 3 2 1\r\n";
  const std::string characters = "0123456789 \t\n\r#/\\-+.eEvfnta\x01\x7f";
  int plain_count = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = start;
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const char character = characters[random() % characters.size()];
      if (random() % 2 == 0)
        text[at] = character;
      else
        text.insert(at, 1, character);
    }
    plain_count += read_plain_obj(text, 1 + random() % 4) ? 1 : 0;
    check_against_strict(text);
  }
  CHECK(plain_count > 400);
}

}  // namespace pliant
