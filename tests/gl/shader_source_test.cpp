// Flattens shader files that are made up here. This needs no GPU.
#include "gl/shader_source.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"

using namespace pliant;
using gl::Define;
using gl::flatten_shader;
using gl::ShaderFile;

namespace {

constexpr ShaderFile files[] = {
    {"compute/main.comp", "#version 450\n#include \"physics/shared.glsl\"\n#include \"kernels/one.glsl\"\nvoid main() {}\n"},
    {"compute/physics/shared.glsl", "#include <glm/vec3.hpp>\nfloat shared_line;\n"},
    {"compute/kernels/one.glsl", "  #include \"../physics/shared.glsl\"\nfloat kernel_line;"},
    {"compute/virtual.comp", "#version 450\n#include \"@kernel\"\n"},
    {"compute/branches.comp",
     "#version 450\n#ifdef LANES\n#include \"kernels/one.glsl\"\n#else\nfloat without;\n#endif\n#ifdef GL_KHR\n#ifndef "
     "TILE\nfloat untiled;\n"
     "#endif\n#else\nfloat other;\n#endif\n"},
    {"compute/elif.comp", "#version 450\n#ifdef LANES\nfloat a;\n#elif 1\nfloat b;\n#endif\n"},
    {"compute/lost.comp", "#version 450\n\n#include \"nowhere.glsl\"\n"},
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a file that two others include is in the flat shader once") {
  const auto flat = flatten_shader(files, "compute/main.comp");
  CHECK(count(flat.text, "float shared_line;") == 1);
  CHECK(count(flat.text, "float kernel_line;") == 1);
  CHECK(count(flat.text, "#include") == 0);
}

TEST_CASE("a conditional on a define has no #elif") {
  const Define defines[] = {{"LANES", "64"}};
  CHECK(message_of([&] { (void)flatten_shader(files, "compute/elif.comp", defines); }).find("#elif") != std::string::npos);
  CHECK(count(flatten_shader(files, "compute/elif.comp").text, "#elif") == 1);
}

TEST_CASE("every line of a flat shader knows the line it came from") {
  const Define defines[] = {{"LANES", "64"}};
  const auto flat = flatten_shader(files, "compute/main.comp", defines);
  REQUIRE(count(flat.text, "\n") == flat.origins.size());
  CHECK(flat.text == "#version 450\n#define LANES 64\n\nfloat shared_line;\nfloat kernel_line;\nvoid main() {}\n");
  CHECK(flat.origins[3].file == "compute/physics/shared.glsl");
  CHECK(flat.origins[3].line == 2);
  CHECK(flat.origins[5].file == "compute/main.comp");
  CHECK(flat.origins[5].line == 4);
}

TEST_CASE("a virtual include reads the file that its define names") {
  const Define defines[] = {{"@kernel", "compute/kernels/one.glsl"}};
  const auto flat = flatten_shader(files, "compute/virtual.comp", defines);
  CHECK(count(flat.text, "float kernel_line;") == 1);
  CHECK(count(flat.text, "#define") == 0);
  CHECK_THROWS_AS(flatten_shader(files, "compute/virtual.comp"), Error);
}

TEST_CASE("conditionals on names that are defined, or said not to be, are decided, and others are left to the driver") {
  const auto flat = [](const char* lanes, const char* tile) {
    const Define defines[] = {{lanes, "64"}, {tile, ""}};
    const auto shader = flatten_shader(files, "compute/branches.comp", defines);
    CHECK(count(shader.text, "\n") == shader.origins.size());
    return shader.text;
  };
  const std::string defined = flat("LANES", "!TILE"), not_defined = flat("!LANES", "TILE");
  CHECK(count(defined, "float kernel_line;") == 1);
  CHECK(count(defined, "float without;") == 0);
  CHECK(count(defined, "float untiled;") == 1);
  CHECK(count(not_defined, "float kernel_line;") == 0);
  CHECK(count(not_defined, "float without;") == 1);
  CHECK(count(not_defined, "float untiled;") == 0);
  CHECK(count(defined, "#if") == 1);  // the driver's own
  CHECK(count(defined, "#else") == 1);
  CHECK(count(not_defined, "float other;") == 1);
  CHECK(count(not_defined, "#define") == 1);
}

TEST_CASE("a missing shader file is an error that names who asked for it") {
  const std::string message = message_of([] { (void)flatten_shader(files, "compute/lost.comp"); });
  CHECK(message.find("compute/lost.comp:3") != std::string::npos);
  CHECK(message.find("compute/nowhere.glsl") != std::string::npos);
}

TEST_CASE("the logs of Mesa, NVIDIA and glslang come out with true files and lines") {
  const auto flat = flatten_shader(files, "compute/main.comp");  // line 4 is kernels/one.glsl:2
  CHECK(flat.explain("0:4(7): error: syntax") == "compute/kernels/one.glsl:2(7): error: syntax\n");
  CHECK(flat.explain("0(4) : error C0000: syntax") == "compute/kernels/one.glsl:2 : error C0000: syntax\n");
  CHECK(flat.explain("ERROR: 0:4: 'x' : undeclared") == "ERROR: compute/kernels/one.glsl:2: 'x' : undeclared\n");
  CHECK(flat.explain("Compute info\n0(3) : warning\n0:99(1): error\n") ==
        "Compute info\ncompute/physics/shared.glsl:2 : warning\n0:99(1): error\n");
  for (const char* other : {"0", "0:", "0(4", "0(4: error", "4: error", "NOTE: 0:4: x", "0:99999999999999999999: error"})
    CHECK(flat.explain(other) == std::string(other) + "\n");
}

TEST_CASE("every shader in the program flattens or is a fragment that another file includes") {
  CHECK_FALSE(gl::embedded_shaders().empty());
  for (const ShaderFile& file : gl::embedded_shaders()) {
    if (file.text.starts_with("#version") && file.text.find("\"@") == std::string_view::npos) {
      INFO(file.name);
      CHECK_NOTHROW(flatten_shader(file.name));
    }
  }
}
