#include "mesh/generators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "mesh/subdivide.hpp"

namespace pliant {
namespace {

TriangleMesh icosahedron() {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {  // the cyclic permutations of (0, +-1, +-golden ratio)
    for (int signs = 0; signs < 4; ++signs) {
      glm::dvec3 corner(0.0);
      corner[(axis + 1) % 3] = (signs & 1) != 0 ? -1.0 : 1.0;
      corner[(axis + 2) % 3] = (signs & 2) != 0 ? -std::numbers::phi : std::numbers::phi;
      mesh.positions.push_back(glm::normalize(corner));
    }
  }
  mesh.triangles = {{0, 1, 4},   {0, 6, 1},   {0, 4, 8}, {0, 9, 6},  {0, 8, 9}, {1, 10, 4}, {1, 6, 11},
                    {1, 11, 10}, {2, 5, 3},   {2, 3, 7}, {2, 8, 5},  {2, 7, 9}, {2, 9, 8},  {3, 5, 10},
                    {3, 11, 7},  {3, 10, 11}, {4, 5, 8}, {4, 10, 5}, {6, 9, 7}, {6, 7, 11}};
  return mesh;
}

constexpr unsigned max_subdivisions = 9;

TriangleMesh icosphere(std::string_view description, std::string_view argument) {
  unsigned subdivisions = 0;
  const auto [end, status] = std::from_chars(argument.data(), argument.data() + argument.size(), subdivisions);
  const bool whole = status != std::errc::invalid_argument && end == argument.data() + argument.size();
  if (!whole || status != std::errc() || subdivisions > max_subdivisions)
    throw Error(ErrorKind::input, fmt::format("mesh \"{}\"", description),
                whole ? fmt::format("{} subdivisions are beyond {}", argument, max_subdivisions)
                      : fmt::format("\"{}\" is no number of subdivisions", argument),
                fmt::format("write icosphere:n with a whole number n from 0 to {}", max_subdivisions));
  TriangleMesh mesh = icosahedron();
  for (unsigned i = 0; i < subdivisions; ++i) {
    const std::size_t vertices_before = mesh.positions.size();
    mesh = subdivide(mesh, 1);
    for (glm::dvec3& p : std::span(mesh.positions).subspan(vertices_before)) p = glm::normalize(p);
  }
  return mesh;
}

// Makes the surface of a box of cells about the origin. Each vertex is there once, wherever faces share it.
class BoxGrid {
 public:
  BoxGrid(const std::array<unsigned, 3>& cells, const glm::dvec3& size) : cells_(cells), size_(size) {}

  // Adds the face at the lower (0) or upper end (1) of an axis.
  void add_face(std::size_t axis, unsigned end) {
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (unsigned row = 0; row < cells_[next]; ++row)
      for (unsigned column = 0; column < cells_[last]; ++column) {
        const auto corner = [&](unsigned r, unsigned c) {
          std::array<unsigned, 3> at{};
          at[axis] = end * cells_[axis];
          at[next] = row + r;
          at[last] = column + c;
          return vertex(at);
        };
        const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
        if (end == 1)
          mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
        else
          mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
      }
  }

  void add_faces(bool has_top = true) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (unsigned end = 0; end < 2; ++end)
        if (has_top || axis != 1 || end == 0) add_face(axis, end);
  }

  TriangleMesh mesh;

 private:
  std::uint32_t vertex(const std::array<unsigned, 3>& at) {
    const auto [entry, is_new] = vertices_.try_emplace(at, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.emplace_back(coordinate(at, 0), coordinate(at, 1), coordinate(at, 2));
    return entry->second;
  }
  double coordinate(const std::array<unsigned, 3>& at, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    return size_[axis] * (static_cast<double>(at[k]) / cells_[k] - 0.5);
  }

  std::array<unsigned, 3> cells_;
  glm::dvec3 size_;
  std::map<std::array<unsigned, 3>, std::uint32_t> vertices_;
};

constexpr unsigned max_cells = 100;

template <class Number>
bool is_number(std::string_view text, Number& number) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  return status == std::errc() && end == text.data() + text.size();
}

unsigned cells_of(std::string_view description, std::string_view argument, const char* form) {
  unsigned cells = 0;
  if (!is_number(argument, cells) || cells < 1 || cells > max_cells)
    throw Error(ErrorKind::input, fmt::format("mesh \"{}\"", description), fmt::format("\"{}\" is no number of cells", argument),
                fmt::format("write {} with a whole number n from 1 to {}", form, max_cells));
  return cells;
}

TriangleMesh cube(std::string_view description, std::string_view argument) {
  const unsigned cells = cells_of(description, argument, "cube:n");
  BoxGrid grid({cells, cells, cells}, glm::dvec3(1.0));
  grid.add_faces();
  return std::move(grid.mesh);
}

// A box of these sizes, whose longest side has n cells. Cells are as near to squares as whole numbers of them let them be.
BoxGrid box_grid(std::string_view description, std::string_view argument, const char* form) {
  glm::dvec3 size(0.0);
  std::string_view rest = argument;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = rest.find(',');
    if (comma == std::string_view::npos || !is_number(rest.substr(0, comma), size[axis]) ||
        !(size[axis] >= 1e-6 && size[axis] <= 1e6))
      throw Error(ErrorKind::input, fmt::format("mesh \"{}\"", description),
                  "does not say three sizes from 1e-6 to 1e6, and a number of cells",
                  fmt::format("write {}, as in {}2,0.5,2,8", form,
                              std::string_view(form).substr(0, std::string_view(form).find(':') + 1)));
    rest.remove_prefix(comma + 1);
  }
  const double longest = std::max({size.x, size.y, size.z}), most = cells_of(description, rest, form);
  std::array<unsigned, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
    cells[static_cast<std::size_t>(axis)] = std::max(1u, static_cast<unsigned>(std::lround(most * size[axis] / longest)));
  return {cells, size};
}

TriangleMesh box(std::string_view description, std::string_view argument) {
  BoxGrid grid = box_grid(description, argument, "box:x,y,z,n");
  grid.add_faces();
  return std::move(grid.mesh);
}

TriangleMesh crate(std::string_view description, std::string_view argument) {
  BoxGrid grid = box_grid(description, argument, "crate:x,y,z,n");
  grid.add_faces(false);
  return std::move(grid.mesh);
}

// The lower half of a cube's surface, pushed out to the unit sphere.
TriangleMesh bowl(std::string_view description, std::string_view argument) {
  const unsigned cells = cells_of(description, argument, "bowl:n");
  BoxGrid grid({2 * cells, cells, 2 * cells}, {1, 0.5, 1});
  grid.add_faces(false);
  for (glm::dvec3& p : grid.mesh.positions) p = glm::normalize(p - glm::dvec3(0, 0.25, 0));
  return std::move(grid.mesh);
}

// A torus about the y axis. Cells of the tube are as near to squares as whole numbers of them let them be.
TriangleMesh ring(std::string_view description, std::string_view argument) {
  const std::size_t comma = argument.find(',');
  double tube = 0;
  if (comma == std::string_view::npos || !is_number(argument.substr(0, comma), tube) || !(tube > 0 && tube < 1))
    throw Error(ErrorKind::input, fmt::format("mesh \"{}\"", description),
                "does not say the tube's radius, above 0 and below 1, and a number of cells",
                "write ring:r,n, as in ring:0.2,32");
  const unsigned around = std::max(cells_of(description, argument.substr(comma + 1), "ring:r,n"), 3u);
  const unsigned across = std::max(static_cast<unsigned>(std::lround(around * tube)), 3u);
  TriangleMesh mesh;
  for (unsigned row = 0; row < around; ++row)
    for (unsigned column = 0; column < across; ++column) {
      const double a = 2 * std::numbers::pi * row / around, b = 2 * std::numbers::pi * column / across;
      const double from_axis = 1 + tube * std::cos(b);
      mesh.positions.emplace_back(from_axis * std::cos(a), tube * std::sin(b), from_axis * std::sin(a));
      const auto at = [&](unsigned r, unsigned c) { return (row + r) % around * across + (column + c) % across; };
      mesh.triangles.insert(mesh.triangles.end(), {{at(0, 0), at(0, 1), at(1, 1)}, {at(0, 0), at(1, 1), at(1, 0)}});
    }
  return mesh;
}

struct Generator {
  std::string_view name, form;
  TriangleMesh (*generate)(std::string_view description, std::string_view argument);
};

constexpr Generator generators[] = {
    {"icosphere", "icosphere:n", icosphere}, {"cube", "cube:n", cube}, {"box", "box:x,y,z,n", box},
    {"crate", "crate:x,y,z,n", crate},       {"bowl", "bowl:n", bowl}, {"ring", "ring:r,n", ring}};

}  // namespace

std::string generator_forms() {
  std::string forms;
  for (const Generator& generator : generators) forms += fmt::format("{}{}", forms.empty() ? "" : ", ", generator.form);
  return forms;
}

bool is_generator(std::string_view description) {
  const std::size_t colon = description.find(':');
  if (colon == std::string_view::npos || colon < 2 || description.ends_with(".obj")) return false;  // a drive has one letter
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return std::ranges::all_of(description.substr(0, colon), is_letter);
}

TriangleMesh generate_mesh(std::string_view description) {
  const std::string_view name = description.substr(0, description.find(':'));
  const auto found = std::ranges::find(generators, name, &Generator::name);
  if (found == std::end(generators))
    throw Error(ErrorKind::input, fmt::format("mesh \"{}\"", description), fmt::format("there is no generator \"{}\"", name),
                fmt::format("what exists: {}", generator_forms()));
  const bool has_argument = name.size() < description.size();
  return found->generate(description, has_argument ? description.substr(name.size() + 1) : std::string_view());
}

}  // namespace pliant
