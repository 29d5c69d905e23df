// A table reader remembers which keys it was asked for. Below it, each key has one line.
#include "scene/load_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "scene/overrides.hpp"
#include "scene/toml.hpp"
#include "scene/values.hpp"
#include "scene/words.hpp"

namespace pliant {
namespace {

// ---- Tables ----

// Reads keys of one table, or of another one in front of it. Whatever they hold beyond these keys is an error in finish().
class TableReader {
 public:
  TableReader(const toml::table& table, std::string path, const toml::table* front = nullptr, std::string front_path = "")
      : table_(table), front_(front), path_(std::move(path)), front_path_(std::move(front_path)) {}

  /// Leaves `value` as it is when the key is absent. `how` is a range or a list of choices.
  template <typename T, typename... How>
  void read(const char* key, T& value, const How&... how) {
    if (const toml::node* node = find(key)) convert(*node, path_of(key), value, how...);
  }

  /// Reads the table below `key` by read_table(TableReader&, T&).
  template <typename T>
  void section(const char* key, T& value) {
    if (const toml::node* node = find(key)) section(*node, path_of(key), value);
  }

  template <typename T>
  void section(const char* key, std::optional<T>& value) {
    if (const toml::node* node = find(key)) section(*node, path_of(key), value.emplace());
  }

  template <typename T>
  static void section(const toml::node& node, const std::string& path, T& value) {
    if (!node.is_table()) fail(node, path, fmt::format("is {}", type_name(node)), fmt::format("write a table, as in [{}]", path));
    TableReader reader(*node.as_table(), path);
    read_table(reader, value);
    reader.finish();
  }

  void require(const char* key) const {
    if (peek(key) == nullptr) fail(table_, path_, fmt::format("has no {}", key), fmt::format("add {} = ...", key));
  }

  /// If both are there, the stronger one replaces the other: see peek(). Call it before either is read.
  void keep_one_of(const char* first, const char* second) {
    const toml::node *one = peek(first), *other = peek(second);
    if (one == nullptr || other == nullptr) return;
    const auto rank = [&](const char* key, const toml::node& node) { return std::pair(is_override(node), is_in_front(key)); };
    if (rank(first, *one) == rank(second, *other))
      fail(*other, path_of(second), fmt::format("can't be combined with {}", first), "keep one of them");
    replaced_.emplace_back(rank(first, *one) > rank(second, *other) ? second : first);
  }

  /// Returns null if the key is absent. An override is stronger than the file, and the table in front than the one behind.
  /// Does not make the key a known one.
  const toml::node* peek(const char* key) const {
    if (std::ranges::find(replaced_, key) != replaced_.end()) return nullptr;
    return is_in_front(key) ? front_->get(key) : table_.get(key);
  }

  /// Whether peek() takes the key from the table in front.
  [[nodiscard]] bool is_in_front(std::string_view key) const {
    const toml::node* const in_front = front_ == nullptr ? nullptr : front_->get(key);
    const toml::node* const behind = table_.get(key);
    return in_front != nullptr && (behind == nullptr || is_override(*in_front) || !is_override(*behind));
  }

  /// Forgets what the table behind says of keys that the one in front lacks.
  void forget_behind(std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (front_ == nullptr || front_->get(key) == nullptr) replaced_.emplace_back(key);
  }

  /// Makes a key known that others read.
  void know(const char* key) { known_.emplace_back(key); }

  const toml::node* find(const char* key) {
    known_.emplace_back(key);
    return peek(key);
  }

  /// Returns an origin from nowhere if the key is absent.
  Origin where(const char* key) const {
    const toml::node* node = peek(key);
    return node == nullptr ? Origin() : origin_of(*node, path_of(key));
  }

  /// Adds where those of the keys stand that are there.
  void note(std::initializer_list<const char*> keys, std::vector<Origin>& found) const {
    for (const char* key : keys)
      if (peek(key) != nullptr) found.push_back(where(key));
  }

  /// Returns the key with its tables, such as "collision.tree.split".
  [[nodiscard]] std::string path_of(std::string_view key) const {
    const std::string& path = is_in_front(key) ? front_path_ : path_;
    return fmt::format("{}{}{}", path, path.empty() ? "" : ".", key);
  }

  void finish() const {
    for (const auto& [key, node] : table_)
      if (front_path_.empty() || !key.str().starts_with('[')) expect_known(key.str(), node);  // other bodies in the rows
    if (front_ == nullptr) return;
    for (const auto& [key, node] : *front_) expect_known(key.str(), node);
  }

 private:
  void expect_known(std::string_view key, const toml::node& node) const {
    if (std::ranges::find(known_, key) == known_.end()) fail(node, path_of(key), "unknown key", suggest(key, known_));
  }

  const toml::table& table_;
  const toml::table* front_;
  std::string path_, front_path_;              // such as "collision.tree"
  std::vector<std::string> known_, replaced_;  // keys
};

// ---- The scene's keys ----

void read_table(TableReader& table, SimulationDescription& simulation) {
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

void read_table(TableReader& table, TreeDescription& tree) {
  table.read("split", tree.split, words::splits);
  table.read("fan_out", tree.fan_out, fan_out);
  if (!std::has_single_bit(tree.fan_out))
    fail(*table.find("fan_out"), table.path_of("fan_out"), fmt::format("{} is not possible", tree.fan_out), "write 2, 4 or 8");
  table.read("refit", tree.refit, words::refits);
  table.read("max_depth", tree.max_depth, tree_depth);
  table.read("leaf_size", tree.leaf_size, triangle_count);
}

void read_surface(TableReader& table, SurfaceDescription& surface) {
  table.read("elasticity", surface.elasticity, fraction);
  table.read("friction", surface.friction, not_negative);
  table.read("gap", surface.gap, edge_part);
}

void read_table(TableReader& table, CollisionDescription& collision) {
  table.read("response", collision.response);
  table.read("elasticity", collision.elasticity, fraction);
  table.read("friction", collision.friction, not_negative);
  table.read("restitution", collision.restitution, fraction);
  table.read("gap", collision.gap, edge_part);
  table.read("search", collision.search, words::searches);
  collision.search_where = table.where("search");
  table.read("triangle_test", collision.triangle_test, words::triangle_tests);
  table.section("tree", collision.tree);
  table.note({"friction", "restitution", "gap"}, collision.surface_keys);
}

void read_table(TableReader& table, CameraDescription& camera) {
  table.require("eye");
  table.read("eye", camera.eye, coordinate);
  table.read("target", camera.target, coordinate);
  table.read("field_of_view", camera.field_of_view, view_angle);
  const toml::node* target = table.peek("target");
  if (camera.eye == camera.target)
    fail(target != nullptr && is_override(*target) ? *target : *table.peek("eye"), "output.camera",
         "eye and target are the same point", "move one of them");
}

void read_table(TableReader& table, OutputDescription& output) {
  table.read("frame_rate", output.frame_rate, frames_per_second);
  table.read("size", output.size, pixel_count);
  table.section("camera", output.camera);
  table.read("coloring", output.coloring, words::colorings);
  table.read("marks", output.marks, words::all_marks);
  table.read("ground_height", output.ground_height, coordinate);
}

// What a kind of body can't have.
void expect_none_of(const TableReader& table, std::initializer_list<const char*> keys, const char* why,
                    const char* instead = "change kind") {
  for (const char* key : keys)
    if (table.peek(key) != nullptr) throw Error(table.where(key), why, fmt::format("remove {}, or {}", key, instead));
}

void expect_keys_of_kind(const TableReader& table, const BodyDescription& body) {
  if (body.kind != BodyKind::scripted) {
    if (body.is_container) expect_none_of(table, {"repeats"}, "has no path to repeat", "add a path");
    expect_none_of(table, {"path", "repeats"}, "is for bodies of the kind \"scripted\"");
  }
  if (body.kind == BodyKind::immovable)
    expect_none_of(table, {"velocity", "spin", "stretch", "pressure", "self_contact"},
                   "a static body neither moves nor changes its shape");
  if (body.kind != BodyKind::scripted) return;
  expect_none_of(table, {"stretch", "pressure", "self_contact"}, "a scripted body does not change its shape");
  expect_none_of(table, {"restitution"}, "a scripted body takes no part in impacts that restitution restores");
  if (body.path.empty())
    expect_none_of(table, {"repeats"}, "has no path to repeat", "add a path");
  else
    expect_none_of(table, {"velocity", "spin"}, "what has a path moves along it alone", "path");
}

constexpr const char* keys_of_some_bodies[] = {"stiffness",  "total_stiffness", "vertex_mass",
                                               "total_mass", "damping",         "pressure_law"};

// Returns why such a key changes nothing for the body, or nothing if it does.
std::string_view why_idle(const BodyDescription& body, std::string_view key) {
  if (body.kind == BodyKind::immovable) return "on a static body";
  if (body.kind == BodyKind::scripted) return "on a scripted body";
  return key == "pressure_law" && body.pressure == 0 ? "without pressure" : "";
}

void note_idle(const TableReader& table, BodyDescription& body) {
  for (const char* key : keys_of_some_bodies)
    if (const std::string_view why = why_idle(body, key); table.peek(key) != nullptr && !why.empty())
      body.idle_keys.push_back({table.where(key), why});
}

// If one of the bodies in rows is of another kind, what the others do means nothing for it.
void forget_motion_of_rows(TableReader& table, BodyKind kind) {
  if (kind == BodyKind::soft)
    table.forget_behind({"path", "repeats"});
  else if (kind == BodyKind::scripted)
    table.forget_behind({"restitution"});
  if (kind != BodyKind::soft)
    table.forget_behind({"velocity", "spin", "stretch", "pressure", "pressure_law", "self_contact", "stiffness",
                         "total_stiffness", "vertex_mass", "total_mass", "damping", "path", "repeats"});
}

void read_table(TableReader& table, PathKeyDescription& key) {
  table.require("time");
  table.read("time", key.time, not_negative);
  table.read("position", key.position, coordinate);
  table.read("rotation", key.rotation, coordinate);
}

// The angles of a key may be any number of turns from another's, but for rounding.
bool is_same_place(const PathKeyDescription& a, const PathKeyDescription& b) {
  const glm::dvec3 turns = (a.rotation - b.rotation) / 360.0;
  return a.position == b.position && glm::all(glm::lessThan(glm::abs(turns - glm::round(turns)), glm::dvec3(1e-9)));
}

// What a key leaves out is as in the key before.
void read_path(const toml::node& node, const std::string& path, BodyDescription& body) {
  if (!node.is_array() || node.as_array()->size() < 2)
    fail(node, path, node.is_array() ? "has fewer than two keys" : fmt::format("is {}", type_name(node)),
         "write keys, as in [{ time = 0 }, { time = 1, position = [0, 1, 0] }]");
  for (std::size_t k = 0; k < node.as_array()->size(); ++k) {
    const toml::node& key = (*node.as_array())[k];
    const std::string place = fmt::format("{}[{}]", path, k);
    PathKeyDescription next = k > 0 ? body.path.back() : PathKeyDescription();
    TableReader::section(key, place, next);
    if (k > 0 && !(next.time > body.path.back().time))
      fail(key, place + ".time", fmt::format("{} s is not after the key before, at {} s", next.time, body.path.back().time),
           "sort the keys by time");
    body.path.push_back(next);
  }
  if (body.repeats && !is_same_place(body.path.front(), body.path.back()))
    fail((*node.as_array())[body.path.size() - 1], path, "repeats, but does not end where it begins",
         "give the last key the position of the first, and its rotation or whole turns from it");
}

void read_motion(TableReader& table, BodyDescription& body) {
  table.read("position", body.position, coordinate);
  table.read("rotation", body.rotation, coordinate);
  table.read("velocity", body.velocity, coordinate);
  table.read("spin", body.spin, coordinate);
  table.read("repeats", body.repeats);
  if (const toml::node* path = table.find("path")) read_path(*path, table.path_of("path"), body);
}

void read_table(TableReader& table, BodyDescription& body) {
  table.require("mesh");
  table.know("count");
  table.know("spacing");
  table.read("name", body.name);
  table.read("kind", body.kind, words::kinds);
  if (table.is_in_front("kind")) forget_motion_of_rows(table, body.kind);
  body.kind_where = table.where("kind");
  table.read("mesh", body.mesh);
  body.mesh_where = table.where("mesh");
  table.read("weld", body.weld, not_negative);
  table.read("scale", body.scale, positive);
  read_motion(table, body);
  table.read("stretch", body.stretch, coordinate);
  if (body.stretch == glm::dvec3(0.0))
    throw Error(table.where("stretch"), "presses the body into one point, where no spring has a direction",
                "write a factor other than 0 for an axis");
  table.keep_one_of("stiffness", "total_stiffness");
  table.read("stiffness", body.stiffness, not_negative);
  table.read("total_stiffness", body.total_stiffness, not_negative);
  table.keep_one_of("vertex_mass", "total_mass");
  table.read("vertex_mass", body.vertex_mass, positive);
  table.read("total_mass", body.total_mass, positive);
  table.read("damping", body.damping, not_negative);
  read_surface(table, body.surface);
  table.read("restitution", body.restitution, fraction);
  table.read("self_contact", body.self_contact);
  body.self_contact_where = table.where("self_contact");
  table.read("pressure", body.pressure, not_negative);
  table.read("pressure_law", body.pressure_law, words::pressure_laws);
  table.read("color", body.color, fraction);
  table.note({"elasticity", "friction", "gap", "restitution"}, body.surface_keys);
  expect_keys_of_kind(table, body);
  note_idle(table, body);
}

// The bodies of one table with a count, in rows along x, y and z.
struct Rows {
  glm::uvec3 count{1};
  glm::dvec3 spacing{0.0};  // [m]
};

// Reads the scene's bodies, one table after the other.
class BodyReader {
 public:
  explicit BodyReader(std::vector<BodyDescription>& bodies) : bodies_(bodies) {}

  /// Without a name the body is "body0", "body1", ... by its table's index.
  void read(const toml::node& node, std::size_t index) {
    const std::string name = name_of(node, index);
    const toml::table* table = node.as_table();
    take_name(node, name);
    if (table == nullptr || !table->contains("count"))
      read_one(node, name);
    else
      read_rows(*table, name);
  }

 private:
  void read_rows(const toml::table& table, const std::string& name) {
    const std::string path = "body." + name;
    Rows rows;
    TableReader reader(table, path);
    reader.read("count", rows.count, row_length);
    reader.require("spacing");
    reader.read("spacing", rows.spacing, coordinate);
    expect_few(table, path, rows.count);
    for (const auto& [key, node] : table)
      if (key.str().starts_with('[')) expect_one_of(rows.count, key.str(), node, path);
    const std::size_t first = bodies_.size();
    for (std::uint32_t x = 0; x < rows.count.x; ++x)
      for (std::uint32_t y = 0; y < rows.count.y; ++y)
        for (std::uint32_t z = 0; z < rows.count.z; ++z) read_in_row(table, name, {x, y, z}, rows.spacing);
    for (BodyDescription& body : std::span(bodies_).subspan(first))
      std::erase_if(body.idle_keys, [&](const IdleKey& key) { return heeded_.contains(key.where.place); });
  }

  void read_in_row(const toml::table& table, const std::string& name, const glm::uvec3& place, const glm::dvec3& spacing) {
    const std::string key = key_of_place(place);
    const toml::table* own = table.get_as<toml::table>(key);
    TableReader reader(table, "body." + name, own, "body." + name + key);
    BodyDescription body = next_body(own != nullptr ? *own : table);
    read_table(reader, body);
    reader.finish();
    body.name = name + key;
    if (!reader.is_in_front("position")) body.position += glm::dvec3(place) * spacing;
    take_name(table, body.name);
    for (const char* of_some : keys_of_some_bodies)
      if (reader.peek(of_some) != nullptr && why_idle(body, of_some).empty()) heeded_.insert(reader.where(of_some).place);
    bodies_.push_back(std::move(body));
  }

  void read_one(const toml::node& node, const std::string& name) {
    if (const toml::table* table = node.as_table()) expect_no_rows(*table, "body." + name);
    BodyDescription body = next_body(node);
    body.name = name;
    TableReader::section(node, "body." + name, body);
    bodies_.push_back(std::move(body));
  }

  [[nodiscard]] BodyDescription next_body(const toml::node& node) const {
    BodyDescription body;
    body.where = place_of(node);
    body.color = default_color(bodies_.size());
    return body;
  }

  void take_name(const toml::node& node, const std::string& name) {
    if (!names_.insert(name).second)
      fail(node, "body." + name, "the name is taken", "give each body a name of its own; without one it is called by its index");
  }

  static void expect_no_rows(const toml::table& table, const std::string& path) {
    for (const auto& [key, node] : table) {
      const bool is_place = key.str().starts_with('[');
      if (is_place || key.str() == "spacing")
        fail(node, fmt::format("{}{}{}", path, is_place ? "" : ".", key.str()), "is for bodies in rows, which have a count",
             "add count, as in count = [2, 1, 2]");
    }
  }

  static void expect_few(const toml::table& table, const std::string& path, const glm::uvec3& count) {
    const double bodies = static_cast<double>(count.x) * count.y * count.z;
    if (bodies > row_length.highest)
      fail(*table.get("count"), path + ".count", fmt::format("makes {} bodies", bodies), "there may be 65535");
  }

  static void expect_one_of(const glm::uvec3& count, std::string_view key, const toml::node& node, const std::string& path) {
    const std::string place = fmt::format("{}{}", path, key);
    const std::optional<glm::uvec3> found = place_in(key);
    if (!found || found->x >= count.x || found->y >= count.y || found->z >= count.z)
      fail(node, place, fmt::format("is none of the bodies, which go from [0,0,0] to {}", key_of_place(count - 1u)),
           "write the place of one of them, as in \"[0,0,0]\"");
    if (!node.is_table())
      fail(node, place, fmt::format("is {}", type_name(node)), "write a table, as in { velocity = [1, 0, 0] }");
    for (const char* of_rows : {"name", "count", "spacing"})
      if (const toml::node* given = node.as_table()->get(of_rows))
        fail(*given, fmt::format("{}.{}", place, of_rows), "is for all bodies in the rows together",
             fmt::format("remove {}", of_rows));
  }

  std::vector<BodyDescription>& bodies_;
  std::unordered_set<std::string> names_;
  std::set<std::string> heeded_;  // places of keys. A key of rows has an effect if it has one on any of their bodies
};

void read_bodies(const toml::node& node, std::vector<BodyDescription>& bodies) {
  if (!node.is_array())
    fail(node, "body", fmt::format("is {}", type_name(node)),
         is_override(node) ? "name a body and a key, as in --set 'body.NAME.velocity=[1,0,0]'" : "begin each body with [[body]]");
  BodyReader reader(bodies);
  for (std::size_t i = 0; i < node.as_array()->size(); ++i) reader.read((*node.as_array())[i], i);
}

// Returns the mesh of a box whose cells are an eighth of its longest side.
std::string box_mesh(TableReader& table) {
  glm::dvec3 size(0.0);
  bool open = false;
  expect_none_of(table, {"radius"}, "a box has sizes", "write shape = \"sphere\"");
  table.require("size");
  table.read("size", size, box_side);
  table.read("open", open);
  return fmt::format("{}:{},{},{},8", open ? "crate" : "box", size.x, size.y, size.z);
}

std::string sphere_mesh(TableReader& table, BodyDescription& container) {
  expect_none_of(table, {"size", "open"}, "a sphere has a radius alone", "write shape = \"box\"");
  table.require("radius");
  table.read("radius", container.scale, positive);
  return "icosphere:3";
}

// A rigid body whose walls hold others from all sides. It is scripted if something moves it.
void read_container(TableReader& table, BodyDescription& container) {
  words::ContainerShape shape = words::ContainerShape::box;
  table.read("name", container.name);
  table.read("shape", shape, words::container_shapes);
  container.mesh = shape == words::ContainerShape::box ? box_mesh(table) : sphere_mesh(table, container);
  container.mesh_where = table.where("shape");
  read_motion(table, container);
  read_surface(table, container.surface);
  table.read("color", container.color, fraction);
  table.note({"elasticity", "friction", "gap"}, container.surface_keys);
  const bool moves = !container.path.empty() || container.velocity != glm::dvec3(0.0) || container.spin != glm::dvec3(0.0);
  container.kind = moves ? BodyKind::scripted : BodyKind::immovable;
  if (moves)
    expect_keys_of_kind(table, container);
  else
    expect_none_of(table, {"repeats"}, "has no path to repeat");
}

void read_containers(const toml::node& node, std::vector<BodyDescription>& bodies) {
  if (!node.is_array())
    fail(node, "container", fmt::format("is {}", type_name(node)),
         is_override(node) ? "write all containers, as in --set 'container=[{size=[2,1,2]}]'"
                           : "begin each container with [[container]]");
  std::size_t index = 0;
  for (const toml::node& table : *node.as_array()) {
    BodyDescription container;
    container.is_container = true;
    container.name = fmt::format("container{}", index++);
    container.where = place_of(table);
    container.kind_where = origin_of(table, "container");
    container.color = glm::dvec3(0.55);
    if (!table.is_table()) fail(table, "container", fmt::format("is {}", type_name(table)), "write a table, as in [[container]]");
    TableReader reader(*table.as_table(), "container");
    read_container(reader, container);
    reader.finish();
    if (std::ranges::find(bodies, container.name, &BodyDescription::name) != bodies.end())
      fail(table, "container." + container.name, "the name is taken", "give each body and container a name of its own");
    bodies.push_back(std::move(container));
  }
}

void read_table(TableReader& table, GroundDescription& ground) {
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
    TableReader::section(table, "ground", grounds.back());
  }
}

void read_table(TableReader& table, SceneDescription& scene) {
  table.read("title", scene.title);
  table.read("about", scene.about);
  table.section("simulation", scene.simulation);
  table.section("collision", scene.collision);
  table.section("output", scene.output);
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
  TableReader::section(root, "", scene);
  draw_level_ground(scene);
  if (std::ranges::all_of(scene.bodies, &BodyDescription::is_container))
    throw Error(ErrorKind::input, file.string(), "has no body", "add a [[body]] with a mesh");
  return scene;
}

}  // namespace pliant
