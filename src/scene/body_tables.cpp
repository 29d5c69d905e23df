#include "scene/body_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "core/error.hpp"
#include "scene/place_in_rows.hpp"
#include "scene/table_reader.hpp"
#include "scene/values.hpp"
#include "scene/words.hpp"

namespace pliant {
namespace {

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

constexpr const char* keys_of_some_bodies[] = {"stiffness", "total_stiffness", "vertex_mass",  "total_mass", "damping",
                                               "forces",    "force_tolerance", "pressure_law", "subdivision"};

// Returns why such a key changes nothing for the body, or nothing if it does.
std::string_view why_idle(const BodyDescription& body, std::string_view key) {
  if (key == "subdivision") return body.subdivide == 0 ? "without subdivide" : "";
  if (body.kind == BodyKind::immovable) return "on a static body";
  if (body.kind == BodyKind::scripted) return "on a scripted body";
  if (key == "force_tolerance" && body.forces == ForceSum::direct) return "with forces = \"direct\"";
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
                         "total_stiffness", "vertex_mass", "total_mass", "damping", "forces", "force_tolerance", "path",
                         "repeats"});
}

void read_path_key(TableReader& table, PathKeyDescription& key) {
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
    TableReader::section(key, place, next, read_path_key);
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

void read_body(TableReader& table, BodyDescription& body) {
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
  table.read("subdivide", body.subdivide, subdivisions);
  body.subdivide_where = table.where("subdivide");
  table.read("subdivision", body.subdivision, words::subdivisions);
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
  table.read("forces", body.forces, words::force_sums);
  table.read("force_tolerance", body.force_tolerance, force_tolerance);
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
    read_body(reader, body);
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
    TableReader::section(node, "body." + name, body, read_body);
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
           "write the place of one of them without spaces, as in \"[0,0,0]\"");
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

}  // namespace

void read_surface(TableReader& table, SurfaceDescription& surface) {
  table.read("elasticity", surface.elasticity, fraction);
  table.read("friction", surface.friction, not_negative);
  table.read("gap", surface.gap, edge_part);
}

void read_bodies(const toml::node& node, std::vector<BodyDescription>& bodies) {
  if (!node.is_array())
    fail(node, "body", fmt::format("is {}", type_name(node)),
         is_override(node) ? "name a body and a key, as in --set 'body.NAME.velocity=[1,0,0]'" : "begin each body with [[body]]");
  BodyReader reader(bodies);
  for (std::size_t i = 0; i < node.as_array()->size(); ++i) reader.read((*node.as_array())[i], i);
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

}  // namespace pliant
