// Each key has one line.
#include "scene/load_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "scene/body_tables.hpp"
#include "scene/overrides.hpp"
#include "scene/table_reader.hpp"
#include "scene/toml.hpp"
#include "scene/values.hpp"
#include "scene/words.hpp"

namespace pliant {
namespace {

void read_simulation(TableReader& table, SimulationDescription& simulation) {
  table.read("integrator", simulation.integrator);
  table.keep_one_of("time_step", "tolerance");
  const toml::node* time_step = table.find("time_step");
  if (time_step != nullptr && time_step->value<std::string>() != "auto")
    convert(*time_step, "simulation.time_step", simulation.time_step, positive_or_auto);
  table.read("tolerance", simulation.tolerance, error_tolerance);
  simulation.tolerance_where = table.where("tolerance");
  table.read("duration", simulation.duration, not_negative);
  simulation.time_step_where = table.where("time_step");
  simulation.duration_where = table.where("duration");
  table.read("damping_law", simulation.damping_law, words::damping_laws);
  table.read("gravity", simulation.gravity, coordinate);
  table.read("sleep", simulation.sleep);
  simulation.sleep_where = table.where("sleep");
}

void read_tree(TableReader& table, TreeDescription& tree) {
  table.read("split", tree.split, words::splits);
  table.read("fan_out", tree.fan_out, fan_out);
  if (!std::has_single_bit(tree.fan_out))
    fail(*table.find("fan_out"), table.path_of("fan_out"), fmt::format("{} is not possible", tree.fan_out), "write 2, 4 or 8");
  table.read("refit", tree.refit, words::refits);
  table.read("max_depth", tree.max_depth, tree_depth);
  table.read("leaf_size", tree.leaf_size, triangle_count);
}

void read_collision(TableReader& table, CollisionDescription& collision) {
  table.read("response", collision.response);
  table.read("elasticity", collision.elasticity, fraction);
  table.read("friction", collision.friction, not_negative);
  table.read("restitution", collision.restitution, fraction);
  table.read("gap", collision.gap, edge_part);
  table.read("search", collision.search, words::searches);
  collision.search_where = table.where("search");
  table.read("triangle_test", collision.triangle_test, words::triangle_tests);
  table.section("tree", collision.tree, read_tree);
  table.note({"friction", "restitution", "gap"}, collision.surface_keys);
}

void read_camera(TableReader& table, CameraDescription& camera) {
  table.require("eye");
  table.read("eye", camera.eye, coordinate);
  table.read("target", camera.target, coordinate);
  table.read("field_of_view", camera.field_of_view, view_angle);
  const toml::node* target = table.peek("target");
  if (camera.eye == camera.target)
    fail(target != nullptr && is_override(*target) ? *target : *table.peek("eye"), "output.camera",
         "eye and target are the same point", "move one of them");
}

void read_output(TableReader& table, OutputDescription& output) {
  table.read("frame_rate", output.frame_rate, frames_per_second);
  table.read("size", output.size, pixel_count);
  table.section("camera", output.camera, read_camera);
  table.read("coloring", output.coloring, words::colorings);
  table.read("marks", output.marks, words::all_marks);
  table.read("ground_height", output.ground_height, coordinate);
}

void read_ground(TableReader& table, GroundDescription& ground) {
  double height = 0;
  table.keep_one_of("height", "point");
  table.keep_one_of("height", "normal");
  table.read("height", height, coordinate);
  ground.point.y = height;
  table.read("point", ground.point, coordinate);
  table.read("normal", ground.normal, coordinate);
  if (ground.normal == glm::dvec3(0.0))
    throw Error(table.where("normal"), "has no direction", "write a vector that leads out of the ground");
  read_surface(table, ground.surface);
}

void read_grounds(const toml::node& node, std::vector<GroundDescription>& grounds) {
  if (!node.is_array())
    fail(node, "ground", fmt::format("is {}", type_name(node)),
         is_override(node) ? "write all grounds, as in --set 'ground=[{height=1}]'" : "begin each ground with [[ground]]");
  for (const toml::node& table : *node.as_array()) {
    grounds.emplace_back().where = origin_of(table, "ground");
    TableReader::section(table, "ground", grounds.back(), read_ground);
  }
}

void read_scene(TableReader& table, SceneDescription& scene) {
  table.read("title", scene.title);
  table.read("about", scene.about);
  table.section("simulation", scene.simulation, read_simulation);
  table.section("collision", scene.collision, read_collision);
  table.section("output", scene.output, read_output);
  if (const toml::node* bodies = table.find("body")) read_bodies(*bodies, scene.bodies);
  if (const toml::node* grounds = table.find("ground")) read_grounds(*grounds, scene.grounds);
  if (const toml::node* containers = table.find("container")) read_containers(*containers, scene.bodies);
}

// The drawn floor is a level ground, if there is one.
void draw_level_ground(SceneDescription& scene) {
  const GroundDescription* const ground = level_ground(scene.grounds);
  if (ground == nullptr) return;
  if (scene.output.ground_height)
    throw Error(ground->where, "is drawn where it is, but output.ground_height says another height",
                "remove output.ground_height");
  scene.output.ground_height = ground->point.y;
}

}  // namespace

glm::dvec3 default_color(std::size_t index) {
  static constexpr glm::dvec3 colors[] = {{0.791, 0.347, 0.0}, {0.0, 0.168, 0.445},   {0.0, 0.342, 0.171},  {0.604, 0.191, 0.386},
                                          {0.665, 0.112, 0.0}, {0.093, 0.456, 0.815}, {0.871, 0.776, 0.054}};
  return colors[index % std::size(colors)];
}

const GroundDescription* level_ground(std::span<const GroundDescription> grounds) {
  const auto found = std::ranges::find_if(grounds, [](const GroundDescription& ground) {
    return ground.normal.x == 0 && ground.normal.z == 0 && ground.normal.y >= 0;
  });
  return found == grounds.end() ? nullptr : &*found;
}

SceneDescription load_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_text(file), file, overrides);
}

SceneDescription parse_scene(const std::string& text, const std::filesystem::path& file, std::span<const std::string> overrides) {
  toml::table root = parse_toml(text, file);
  for (const std::string& change : overrides) apply_override(root, change);
  SceneDescription scene;
  scene.file = file;
  TableReader::section(root, "", scene, read_scene);
  draw_level_ground(scene);
  if (std::ranges::all_of(scene.bodies, &BodyDescription::is_container))
    throw Error(ErrorKind::input, file.string(), "has no body", "add a [[body]] with a mesh");
  return scene;
}

}  // namespace pliant
