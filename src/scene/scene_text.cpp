// Each key has one line, in the order of load_scene.cpp and body_tables.cpp.
#include "scene/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/expect.hpp"
#include "mesh/generators.hpp"
#include "scene/words.hpp"

namespace pliant {
namespace {

// ---- Values ----

std::string text_of(double value) { return fmt::format("{}", value); }
std::string text_of(unsigned value) { return fmt::format("{}", value); }
std::string text_of(bool value) { return value ? "true" : "false"; }

std::string text_of(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}
std::string text_of(const std::string& value) { return text_of(std::string_view(value)); }
std::string text_of(const Named& named) { return text_of(std::string_view(named.value)); }

template <int length, typename T, glm::qualifier precision>
std::string text_of(const glm::vec<length, T, precision>& value) {
  std::string text;
  for (int i = 0; i < length; ++i) text += (i > 0 ? ", " : "") + text_of(value[i]);
  return "[" + text + "]";
}

std::string text_of(const std::vector<PathKeyDescription>& path) {
  std::string text = "[\n";
  for (const PathKeyDescription& key : path)
    text += fmt::format("  {{ time = {}, position = {}, rotation = {} }},\n", text_of(key.time), text_of(key.position),
                        text_of(key.rotation));
  return text + "]";
}

template <typename Enum>
std::string text_of(Enum value, const std::vector<Choice<Enum>>& choices) {
  const auto found = std::ranges::find(choices, value, &Choice<Enum>::value);
  PLIANT_EXPECT(found != choices.end());
  return text_of(std::string_view(found->name));
}

// ---- Tables ----

/// The lines of one table.
struct TableText {
  std::string lines;

  template <typename T, typename... How>
  void write(const char* key, const T& value, const How&... choices) {
    lines += fmt::format("{} = {}\n", key, text_of(value, choices...));
  }
  template <typename T, typename... How>
  void write(const char* key, const std::optional<T>& value, const How&... choices) {
    if (value) write(key, *value, choices...);
  }
  /// Leaves the default out.
  template <typename T, typename... How>
  void write_other(const char* key, const T& value, const T& fallback, const How&... choices) {
    if (!(value == fallback)) write(key, value, choices...);
  }
  /// A section without lines is left out.
  [[nodiscard]] std::string section(const char* name) const {
    return lines.empty() ? "" : fmt::format("\n[{}]\n{}", name, lines);
  }
  [[nodiscard]] std::string element(const char* name) const { return fmt::format("\n[[{}]]\n{}", name, lines); }
};

std::string text_of(const SimulationDescription& simulation) {
  const SimulationDescription standard;
  TableText table;
  table.write("integrator", simulation.integrator);
  table.write("time_step", simulation.time_step);
  table.write("tolerance", simulation.tolerance);
  table.write_other("duration", simulation.duration, standard.duration);
  table.write("damping_law", simulation.damping_law, words::damping_laws);
  table.write_other("gravity", simulation.gravity, standard.gravity);
  table.write_other("sleep", simulation.sleep, standard.sleep);
  return table.section("simulation");
}

std::string text_of(const TreeDescription& tree) {
  const TreeDescription standard;
  TableText table;
  table.write_other("split", tree.split, standard.split, words::splits);
  table.write_other("fan_out", tree.fan_out, standard.fan_out);
  table.write("refit", tree.refit, words::refits);
  table.write("max_depth", tree.max_depth);
  table.write_other("leaf_size", tree.leaf_size, standard.leaf_size);
  return table.section("collision.tree");
}

void write_surface(TableText& table, const SurfaceDescription& surface) {
  table.write("elasticity", surface.elasticity);
  table.write("friction", surface.friction);
  table.write("gap", surface.gap);
}

// What not all responses read is left out where it is the default.
std::string text_of(const CollisionDescription& collision) {
  const CollisionDescription standard;
  TableText table;
  table.write("response", collision.response);
  table.write("elasticity", collision.elasticity);
  table.write_other("friction", collision.friction, standard.friction);
  table.write("restitution", collision.restitution);
  table.write_other("gap", collision.gap, standard.gap);
  table.write_other("search", collision.search, standard.search, words::searches);
  table.write_other("triangle_test", collision.triangle_test, standard.triangle_test, words::triangle_tests);
  return table.section("collision") + text_of(collision.tree);
}

std::string text_of(const CameraDescription& camera) {
  TableText table;
  table.write("eye", camera.eye);
  table.write("target", camera.target);
  table.write("field_of_view", camera.field_of_view);
  return table.section("output.camera");
}

// A level ground says the height itself.
std::string text_of(const OutputDescription& output, bool has_level_ground) {
  const OutputDescription standard;
  TableText table;
  table.write_other("frame_rate", output.frame_rate, standard.frame_rate);
  table.write_other("size", output.size, standard.size);
  table.write_other("coloring", output.coloring, standard.coloring, words::colorings);
  table.write_other("marks", output.marks, standard.marks, words::all_marks);
  if (!has_level_ground) table.write("ground_height", output.ground_height);
  return table.section("output") + (output.camera ? text_of(*output.camera) : "");
}

void write_motion(TableText& table, const BodyDescription& body) {
  const BodyDescription standard;
  table.write_other("position", body.position, standard.position);
  table.write_other("rotation", body.rotation, standard.rotation);
  table.write_other("velocity", body.velocity, standard.velocity);
  table.write_other("spin", body.spin, standard.spin);
  table.write_other("repeats", body.repeats, standard.repeats);
  if (!body.path.empty()) table.write("path", body.path);
}

std::string mesh_from(const std::filesystem::path& folder, const SceneDescription& scene, const std::string& mesh) {
  if (is_generator(mesh)) return mesh;
  return std::filesystem::proximate(scene.file.parent_path() / mesh, folder.empty() ? "." : folder).generic_string();
}

void write_material(TableText& table, const BodyDescription& body) {
  const BodyDescription standard;
  if (body.total_stiffness)
    table.write("total_stiffness", body.total_stiffness);
  else
    table.write_other("stiffness", body.stiffness, standard.stiffness);
  if (body.total_mass)
    table.write("total_mass", body.total_mass);
  else
    table.write_other("vertex_mass", body.vertex_mass, standard.vertex_mass);
  table.write_other("damping", body.damping, standard.damping);
  table.write_other("forces", body.forces, standard.forces, words::force_sums);
  table.write("force_tolerance", body.force_tolerance);
}

std::string text_of_body(const BodyDescription& body, const std::string& mesh, std::size_t index) {
  const BodyDescription standard;
  TableText table;
  table.write("name", body.name);
  table.write_other("kind", body.kind, standard.kind, words::kinds);
  table.write("mesh", mesh);
  table.write("weld", body.weld);
  table.write_other("subdivide", body.subdivide, standard.subdivide);
  table.write_other("subdivision", body.subdivision, standard.subdivision, words::subdivisions);
  table.write_other("scale", body.scale, standard.scale);
  write_motion(table, body);
  table.write_other("stretch", body.stretch, standard.stretch);
  write_material(table, body);
  write_surface(table, body.surface);
  table.write("restitution", body.restitution);
  table.write_other("self_contact", body.self_contact, standard.self_contact);
  table.write_other("pressure", body.pressure, standard.pressure);
  table.write_other("pressure_law", body.pressure_law, standard.pressure_law, words::pressure_laws);
  table.write_other("color", body.color, default_color(index));
  return table.element("body");
}

// The mesh of a box is "box:x,y,z,cells", or "crate:" without its top.
void write_box(TableText& table, std::string_view mesh) {
  const std::size_t colon = mesh.find(':'), last_comma = mesh.rfind(',');
  table.lines += fmt::format("size = [{}]\n", mesh.substr(colon + 1, last_comma - colon - 1));
  if (mesh.starts_with("crate")) table.write("open", true);
}

std::string text_of_container(const BodyDescription& container) {
  const bool is_sphere = container.mesh.starts_with("icosphere");
  TableText table;
  table.write("name", container.name);
  table.write("shape", is_sphere ? words::ContainerShape::sphere : words::ContainerShape::box, words::container_shapes);
  if (is_sphere)
    table.write("radius", container.scale);
  else
    write_box(table, container.mesh);
  write_motion(table, container);
  write_surface(table, container.surface);
  table.write("color", container.color);
  return table.element("container");
}

std::string text_of(const GroundDescription& ground) {
  const GroundDescription standard;
  TableText table;
  table.write("point", ground.point);
  table.write_other("normal", ground.normal, standard.normal);
  write_surface(table, ground.surface);
  return table.element("ground");
}

}  // namespace

std::string scene_text(const SceneDescription& scene, const std::filesystem::path& folder) {
  TableText table;
  if (!scene.title.empty()) table.write("title", scene.title);
  if (!scene.about.empty()) table.write("about", scene.about);
  std::string text = table.lines + text_of(scene.simulation) + text_of(scene.collision) +
                     text_of(scene.output, level_ground(scene.grounds) != nullptr);
  for (const GroundDescription& ground : scene.grounds) text += text_of(ground);
  std::size_t index = 0;
  for (const BodyDescription& body : scene.bodies)
    text += body.is_container ? text_of_container(body) : text_of_body(body, mesh_from(folder, scene, body.mesh), index++);
  return text;
}

}  // namespace pliant
