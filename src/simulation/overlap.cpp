#define REAL_BITS 64
#include "simulation/overlap.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "collision/responses/impulse.hpp"
#include "model/inside.hpp"
#include "physics/collision/certified_triangles.glsl"
#include "physics/contact/features.glsl"
#include "simulation/near_boxes.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_tests = 20'000'000;  // of a vertex against a triangle, some two seconds

std::span<const glm::dvec3> vertices_of(const ModelBody& body, std::span<const glm::dvec3> positions) {
  return positions.subspan(body.first_vertex, body.vertex_count);
}

IndexedBox box_of(const ModelBody& body, std::span<const glm::dvec3> positions) {
  IndexedBox box;
  for (const glm::dvec3& place : vertices_of(body, positions)) box.add(place);
  return box;
}

// Relative to a corner, because positions in the world lose digits in fp32.
bool may_touch(const Model& model, std::span<const glm::dvec3> positions, std::uint32_t s, std::uint32_t t) {
  const glm::dvec3 origin = positions[model.triangles[s][0]];
  glm::vec3 first[3], second[3];
  for (std::size_t k = 0; k < 3; ++k) {
    first[k] = positions[model.triangles[s][k]] - origin;
    second[k] = positions[model.triangles[t][k]] - origin;
  }
  return physics::triangles_may_touch(first, second);
}

bool may_touch(const Model& model, const ModelBody& a, const ModelBody& b, std::span<const glm::dvec3> positions) {
  const IndexedBox box_a = box_of(a, positions), box_b = box_of(b, positions);
  if (!are_near(box_a, box_b, 0)) return false;
  bool touch = false;
  for_each_near_triangles(model, a, box_a, b, box_b, positions, 0,
                          [&](std::uint32_t s, std::uint32_t t) { touch = touch || may_touch(model, positions, s, t); });
  return touch;
}

double distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 weight = physics64::closest_on_triangle(p, a, b, c);
  return glm::length(p - (weight.x * a + weight.y * b + weight.z * c));
}

// How far the point is inside the body, or 0 if it is outside [m].
double depth_in(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions, const glm::dvec3& point) {
  if (!is_inside(point, model, body, positions)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& [a, b, c] = model.triangles[t];
    nearest = std::min(nearest, distance(point, positions[a], positions[b], positions[c]));
  }
  return nearest;
}

// The largest depth of the first body's vertices in the second. Of a large mesh it looks at some vertices only.
double deepest(const Model& model, const ModelBody& of, const ModelBody& in, std::span<const glm::dvec3> positions) {
  const IndexedBox box = box_of(in, positions);
  const std::size_t stride = 1 + std::size_t{of.vertex_count} * in.triangle_count / most_tests;
  double depth = 0;
  for (std::size_t i = of.first_vertex; i < of.first_vertex + of.vertex_count; i += stride)
    if (are_near({.lower = positions[i], .upper = positions[i]}, box, 0))
      depth = std::max(depth, depth_in(model, in, positions, positions[i]));
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

std::optional<Overlap> find_overlap(const Model& model, std::span<const glm::dvec3> positions,
                                    std::span<const std::uint32_t> bodies, const CollisionDescription& collision) {
  std::optional<Overlap> found;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const ModelBody &a = model.bodies[bodies[i]], &b = model.bodies[bodies[j]];
      if ((a.is_static && b.is_static) || !may_touch(model, a, b, positions)) continue;
      const double depth = std::max(deepest(model, a, b, positions), deepest(model, b, a, positions));
      if (!found || depth > found->depth) found = {.first = bodies[i], .second = bodies[j], .depth = depth};
    }
  if (!found) return {};
  const ModelBody &first = model.bodies[found->first], &second = model.bodies[found->second];
  found->way_out =
      way_out(vertices_of(first, positions), vertices_of(second, positions), gap_between(model, first, second, collision));
  return found;
}

}  // namespace pliant
