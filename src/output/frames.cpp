#include "output/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>

#include "core/bytes.hpp"
#include "core/expect.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's byte order");

void write_text(const std::filesystem::path& path, const std::string& text) {
  WholeFile file(path);
  file.write(text);
  file.close();
}

// Replaces blanks and control characters, so that no reader takes the name for two words or two lines.
std::string one_word(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c <= ' ' || c == 0x7F; }, '_');
  return name;
}

unsigned char to_srgb_byte(double linear) {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  const double srgb = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * srgb));
}

std::string ply_header(const Model& model) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by pliant\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float vx\nproperty float vy\nproperty float vz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int body\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      model.vertex_count(), model.triangles.size());
}

void append_ply_vertex(std::string& text, const glm::dvec3& position, const glm::dvec3& velocity, const glm::dvec3& color,
                       std::int32_t body) {
  for (int axis = 0; axis < 3; ++axis) append_bytes(text, position[axis]);
  for (int axis = 0; axis < 3; ++axis) append_bytes(text, static_cast<float>(velocity[axis]));
  for (int channel = 0; channel < 3; ++channel) append_bytes(text, to_srgb_byte(color[channel]));
  append_bytes(text, body);
}

void append_lines(std::string& text, std::span<const glm::dvec3> vectors) {
  for (const glm::dvec3& v : vectors) fmt::format_to(std::back_inserter(text), "{:.12g} {:.12g} {:.12g}\n", v.x, v.y, v.z);
}

}  // namespace

std::filesystem::path frame_path(const std::filesystem::path& folder, int index, FrameFormat format) {
  PLIANT_EXPECT(format != FrameFormat::none);
  constexpr const char* extensions[] = {"", "png", "obj", "ply", "vtk"};
  return folder / fmt::format("frame_{:04}.{}", index, extensions[static_cast<int>(format)]);
}

void write_obj(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions) {
  PLIANT_EXPECT(positions.size() == model.vertex_count());
  std::string text = "# written by pliant\n";
  for (const ModelBody& body : model.bodies) {
    fmt::format_to(std::back_inserter(text), "o {}\n", one_word(body.name));
    for (const glm::dvec3& p : positions.subspan(body.first_vertex, body.vertex_count))
      fmt::format_to(std::back_inserter(text), "v {:.12g} {:.12g} {:.12g}\n", p.x, p.y, p.z);
    for (const auto& [a, b, c] : std::span(model.triangles).subspan(body.first_triangle, body.triangle_count))
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  write_text(path, text);
}

void write_ply(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities) {
  PLIANT_EXPECT(positions.size() == model.vertex_count() && velocities.size() == model.vertex_count());
  std::string text = ply_header(model);
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    const ModelBody& range = model.bodies[body];
    for (std::uint32_t i = range.first_vertex; i < range.first_vertex + range.vertex_count; ++i)
      append_ply_vertex(text, positions[i], velocities[i], range.color, static_cast<std::int32_t>(body));
  }
  for (const auto& corners : model.triangles) {
    append_bytes(text, std::uint8_t{3});
    for (const std::uint32_t corner : corners) append_bytes(text, static_cast<std::int32_t>(corner));
  }
  write_text(path, text);
}

void write_vtk(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
               std::span<const glm::dvec3> velocities) {
  PLIANT_EXPECT(positions.size() == model.vertex_count() && velocities.size() == model.vertex_count());
  const auto triangle_count = model.triangles.size();
  std::string text =
      fmt::format("# vtk DataFile Version 3.0\npliant\nASCII\nDATASET POLYDATA\nPOINTS {} double\n", positions.size());
  const auto out = std::back_inserter(text);
  append_lines(text, positions);
  fmt::format_to(out, "POLYGONS {} {}\n", triangle_count, 4 * triangle_count);
  for (const auto& [a, b, c] : model.triangles) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  fmt::format_to(out, "POINT_DATA {}\nVECTORS velocity double\n", positions.size());
  append_lines(text, velocities);
  text += "SCALARS body int 1\nLOOKUP_TABLE default\n";
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    for (std::uint32_t i = 0; i < model.bodies[body].vertex_count; ++i) fmt::format_to(out, "{}\n", body);
  write_text(path, text);
}

}  // namespace pliant
