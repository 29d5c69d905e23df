#include "simulation/overlap.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

#include "collision/responses/impulse.hpp"
#include "model/inside.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_tests = 20'000'000;  // of a vertex against a triangle, some two seconds

using Corners = std::array<glm::dvec3, 3>;

struct Extent {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
};

std::span<const glm::dvec3> vertices_of(const ModelBody& body, std::span<const glm::dvec3> positions) {
  return positions.subspan(body.first_vertex, body.vertex_count);
}

Extent extent_of(std::span<const glm::dvec3> places) {
  Extent extent;
  for (const glm::dvec3& place : places) {
    extent.lower = glm::min(extent.lower, place);
    extent.upper = glm::max(extent.upper, place);
  }
  return extent;
}

bool are_apart(const Extent& a, const Extent& b) {
  return glm::any(glm::lessThan(a.upper, b.lower)) || glm::any(glm::lessThan(b.upper, a.lower));
}

// C. Ericson, Real-Time Collision Detection (2005), 5.1.5: the region of the triangle that the point is nearest to.
double distance(const glm::dvec3& p, const Corners& t) {
  const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp),
               d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return glm::length(ap);
  if (d3 >= 0 && d4 <= d3) return glm::length(bp);
  if (d6 >= 0 && d5 <= d6) return glm::length(cp);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - d1 / (d1 - d3) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return glm::length(bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]));
  return glm::length(ap - (vb * ab + vc * ac) / (va + vb + vc));
}

// How far the point is inside the body, or 0 if it is outside [m].
double depth_in(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions, const glm::dvec3& point) {
  if (!is_inside(point, model, body, positions)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& [a, b, c] = model.triangles[t];
    nearest = std::min(nearest, distance(point, {positions[a], positions[b], positions[c]}));
  }
  return nearest;
}

// The largest depth of the first body's vertices in the second. Of a large mesh it looks at some vertices only.
double deepest(const Model& model, const ModelBody& of, const ModelBody& in, std::span<const glm::dvec3> positions) {
  const Extent extent = extent_of(vertices_of(in, positions));
  const std::size_t stride = 1 + std::size_t{of.vertex_count} * in.triangle_count / most_tests;
  double depth = 0;
  for (std::size_t i = of.first_vertex; i < of.first_vertex + of.vertex_count; i += stride)
    if (!are_apart({positions[i], positions[i]}, extent)) depth = std::max(depth, depth_in(model, in, positions, positions[i]));
  return depth;
}

// How far the shadow of the second body has to go along the axis until it has passed that of the first.
double way_along(const glm::dvec3& axis, std::span<const glm::dvec3> first, std::span<const glm::dvec3> second) {
  double most = -std::numeric_limits<double>::infinity(), least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : first) most = std::max(most, glm::dot(axis, p));
  for (const glm::dvec3& p : second) least = std::min(least, glm::dot(axis, p));
  return most - least;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> places) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

// The shortest way along a coordinate axis, or along the line of the middles.
glm::dvec3 way_out(std::span<const glm::dvec3> first, std::span<const glm::dvec3> second, double gap) {
  std::vector<glm::dvec3> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const glm::dvec3 line = middle_of(second) - middle_of(first);
  if (glm::length(line) > 0) axes.push_back(glm::normalize(line));
  glm::dvec3 shortest(std::numeric_limits<double>::infinity());
  for (const glm::dvec3& axis : axes)
    if (const double way = way_along(axis, first, second) + gap; way < glm::length(shortest)) shortest = way * axis;
  return shortest;
}

}  // namespace

double gap_between(const Model& model, const ModelBody& a, const ModelBody& b, const CollisionDescription& collision) {
  return physics::gap_of_pair(surface_of(model, a, collision), surface_of(model, b, collision));
}

Overlap find_overlap(const Model& model, std::span<const glm::dvec3> positions, std::span<const std::uint32_t> bodies,
                     const CollisionDescription& collision) {
  Overlap found{.first = bodies[0], .second = bodies[1], .depth = -1};
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const ModelBody &a = model.bodies[bodies[i]], &b = model.bodies[bodies[j]];
      if (are_apart(extent_of(vertices_of(a, positions)), extent_of(vertices_of(b, positions)))) continue;
      const double depth = std::max(deepest(model, a, b, positions), deepest(model, b, a, positions));
      if (depth > found.depth) found = {.first = bodies[i], .second = bodies[j], .depth = depth};
    }
  const ModelBody &first = model.bodies[found.first], &second = model.bodies[found.second];
  found.way_out =
      way_out(vertices_of(first, positions), vertices_of(second, positions), gap_between(model, first, second, collision));
  return found;
}

}  // namespace pliant
