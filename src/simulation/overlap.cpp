#define REAL_BITS 64
#include "simulation/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "collision/responses/impulse.hpp"
#include "model/inside.hpp"
#include "physics/collision/certified_triangles.glsl"
#include "physics/contact/features.glsl"
#include "physics/contact/separation.glsl"
#include "simulation/near_boxes.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_tests = 20'000'000;  // of a vertex against a triangle, some two seconds
constexpr std::size_t most_measured = 4;        // pairs of bodies

std::span<const glm::dvec3> vertices_of(const ModelBody& body, std::span<const glm::dvec3> positions) {
  return positions.subspan(body.first_vertex, body.vertex_count);
}

IndexedBox box_of(const ModelBody& body, std::span<const glm::dvec3> positions) {
  IndexedBox box;
  for (const glm::dvec3& place : vertices_of(body, positions)) box.add(place);
  return box;
}

using Corners = std::array<std::uint32_t, 3>;

// Relative to a corner, because positions in the world lose digits in fp32.
bool may_touch(std::span<const glm::dvec3> positions, const Corners& s, const Corners& t) {
  const glm::dvec3 origin = positions[s[0]];
  glm::vec3 first[3], second[3];
  for (std::size_t k = 0; k < 3; ++k) {
    first[k] = positions[s[k]] - origin;
    second[k] = positions[t[k]] - origin;
  }
  return physics::triangles_may_touch(first, second);
}

// Finds bodies that proofs of the simulation could not tell apart.
class Search {
 public:
  Search(const Model& model, std::span<const glm::dvec3> positions, int precision)
      : model_(model), positions_(positions), epsilon_(precision == 64 ? 0x1p-52 : 0x1p-23) {
    for (const ModelBody& body : model.bodies) largest_ = std::max(largest_, body.radius);
  }

  // Calls visit(a, b, distance) for each two bodies that may touch, with a distance of 0, or that are nearer than the margin of
  // proofs. Calls no more once that has returned false.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    bool goes_on = true;
    for_each_near_bodies([&](const IndexedBox& a, const IndexedBox& b, double most) {
      if (!goes_on) return;
      double nearest = std::numeric_limits<double>::infinity();
      for_each_near_triangles(model_, model_.bodies[a.index], a, model_.bodies[b.index], b, positions_, most,
                              [&](std::uint32_t s, std::uint32_t t) {
                                nearest = std::min(nearest, distance(model_.triangles[s], model_.triangles[t]));
                              });
      if (nearest < most) goes_on = visit(std::min(a.index, b.index), std::max(a.index, b.index), nearest);
    });
  }

  // Looks at the body's triangles, beyond where they share a vertex. Those that share an edge do not count.
  OwnContacts own_contacts(const ModelBody& body) const {
    OwnContacts found;
    const IndexedBox all = box_of(body, positions_);
    const double most = largest_margin(all, all);
    for_each_near(triangles_near(model_, body, positions_, all, most), most, [&](const IndexedBox& s, const IndexedBox& t) {
      const double apart = own_distance(model_.triangles[s.index], model_.triangles[t.index]);
      found.touching += apart > 0 ? 0 : 1;
      found.too_near += apart > 0 && !std::isinf(apart) ? 1 : 0;
    });
    return found;
  }

  // How many pairs of triangles may touch.
  std::uint64_t count_touching() const {
    std::uint64_t count = 0;
    for (const ModelBody& body : model_.bodies)
      if (body.self_contact) count += own_contacts(body).touching;
    for_each_near_bodies([&](const IndexedBox& a, const IndexedBox& b, double most) {
      for_each_near_triangles(
          model_, model_.bodies[a.index], a, model_.bodies[b.index], b, positions_, most,
          [&](std::uint32_t s, std::uint32_t t) { count += distance(model_.triangles[s], model_.triangles[t]) > 0 ? 0 : 1; });
    });
    return count;
  }

 private:
  // Calls visit(box, box, margin) for each two bodies whose boxes are no further apart than the margin of proofs [m].
  template <class Visit>
  void for_each_near_bodies(const Visit& visit) const {
    std::vector<IndexedBox> boxes;
    IndexedBox all;
    for (std::uint32_t b = 0; b < model_.bodies.size(); ++b) {
      if (model_.bodies[b].triangle_count == 0) continue;
      IndexedBox& box = boxes.emplace_back(box_of(model_.bodies[b], positions_));
      box.index = b;
      for (const glm::dvec3& p : {box.lower, box.upper}) all.add(p);
    }
    for_each_near(std::move(boxes), largest_margin(all, all), [&](const IndexedBox& a, const IndexedBox& b) {
      const double most = largest_margin(a, b);
      if (model_.bodies[a.index].is_rigid() && model_.bodies[b.index].is_rigid()) return;
      if (are_near(a, b, most)) visit(a, b, most);
    });
  }

  // The margin of proofs for a triangle of each box, at most, where the boxes are no further apart than that [m].
  double largest_margin(const IndexedBox& a, const IndexedBox& b) const {
    const double size = 1.01 * (physics::sum_of_sizes(a.upper - a.lower) + physics::sum_of_sizes(b.upper - b.lower));
    const glm::dvec3 farthest =
        glm::max(glm::max(glm::abs(a.lower), glm::abs(a.upper)), glm::max(glm::abs(b.lower), glm::abs(b.upper)));
    const double far = physics::sum_of_sizes(farthest);
    return physics::margin_of_rounding(epsilon_, size, physics::rounded_from(far, far, largest_));
  }

  // As distance(), of two triangles of one body. Those that share a vertex touch elsewhere, too, if the edge across from it of
  // one of them meets the other.
  [[nodiscard]] double own_distance(const Corners& s, const Corners& t) const {
    const auto is_of = [](const Corners& other) {
      return [&](std::uint32_t vertex) { return std::ranges::find(other, vertex) != other.end(); };
    };
    const auto shared = std::ranges::count_if(s, is_of(t));
    if (shared != 1) return shared == 0 ? distance(s, t) : std::numeric_limits<double>::infinity();
    const auto edge_across = [&](const Corners& of, const Corners& other) {
      const auto k = static_cast<std::size_t>(std::ranges::find_if(of, is_of(other)) - of.begin());
      return Corners{of[(k + 1) % 3], of[(k + 2) % 3], of[(k + 2) % 3]};
    };
    return std::min(distance(edge_across(s, t), t), distance(s, edge_across(t, s)));
  }

  // Of two triangles [m]. 0 if they may touch, infinite if proofs can tell that they are apart.
  double distance(const Corners& s, const Corners& t) const {
    physics64::Motion standing;
    double size = 0;
    const glm::dvec3 origin = positions_[s[0]];
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t vertex = k < 3 ? s[k] : t[k - 3];
      standing.start[k] = standing.end[k] = positions_[vertex] - origin;
      size = std::max(size, physics::sum_of_sizes(standing.start[k]));
    }
    const double far = physics::rounded_from(physics::sum_of_sizes(origin), physics::sum_of_sizes(origin), largest_);
    standing.margin = physics::margin_of_rounding(0x1p-52, size, far);
    const double found = physics64::closest_points(standing.start).distance;
    if (may_touch(positions_, s, t) && !physics64::stays_apart(standing)) {
      standing.margin = 4 * 0x1p-52 * size;  // by which shadows alone err
      return physics64::stays_apart(standing) ? found : 0;
    }
    return found < physics::margin_of_rounding(epsilon_, size, far) ? found : std::numeric_limits<double>::infinity();
  }

  const Model& model_;
  std::span<const glm::dvec3> positions_;
  double epsilon_, largest_ = 0;  // radius of a body at rest [m]
};

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
                                    const CollisionDescription& collision, int precision) {
  std::optional<Overlap> found;
  std::size_t measured = 0;
  Search(model, positions, precision).for_each_pair([&](std::uint32_t first, std::uint32_t second, double distance) {
    if (distance > 0 && (!found || (found->distance > 0 && distance < found->distance)))
      found = {.first = first, .second = second, .distance = distance};
    if (distance > 0) return true;
    ++measured;
    const ModelBody &a = model.bodies[first], &b = model.bodies[second];
    const double depth = std::max(deepest(model, a, b, positions), deepest(model, b, a, positions));
    if (!found || found->distance > 0 || depth > found->depth) found = {.first = first, .second = second, .depth = depth};
    return measured < most_measured;
  });
  if (!found || found->distance > 0) return found;
  const ModelBody &first = model.bodies[found->first], &second = model.bodies[found->second];
  found->way_out =
      way_out(vertices_of(first, positions), vertices_of(second, positions), gap_between(model, first, second, collision));
  return found;
}

OwnContacts own_contacts(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions, int precision) {
  return Search(model, positions, precision).own_contacts(body);
}

std::uint64_t count_touching_pairs(const Model& model, std::span<const glm::dvec3> positions) {
  return Search(model, positions, 64).count_touching();
}

}  // namespace pliant
