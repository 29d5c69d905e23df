#include "output/mesh_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <iterator>
#include <string>

#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/extension.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's byte order");

bool is_ply(const std::filesystem::path& path) { return extension_of(path) == ".ply"; }

void expect_mesh_extension(const std::filesystem::path& path) {
  if (is_ply(path) || extension_of(path) == ".obj") return;
  throw Error(ErrorKind::command_line, path.string(), "its extension names no format of meshes", "end it in .obj or .ply");
}

// Numbers have as many digits as it takes to read them back bit for bit.
std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# written by pliant\n";
  const auto out = std::back_inserter(text);
  for (const glm::dvec3& p : mesh.positions) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string ply_bytes(const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by pliant\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  for (const glm::dvec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, p[axis]);
  for (const auto& corners : mesh.triangles) {
    append_bytes(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : corners) append_bytes(bytes, static_cast<std::int32_t>(corner));
  }
  return bytes;
}

}  // namespace

void expect_place_for_mesh(const std::filesystem::path& path) {
  expect_mesh_extension(path);
  expect_writable(path);
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  expect_mesh_extension(path);
  WholeFile file(path);
  file.write(is_ply(path) ? ply_bytes(mesh) : obj_text(mesh));
  file.close();
}

}  // namespace pliant
