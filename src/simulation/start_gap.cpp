// Sorts boxes along x, first of bodies, then of the triangles of two bodies that are near, and measures what is left.
#define REAL_BITS 64
#include "simulation/start_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <span>
#include <utility>

#include "collision/responses/impulse.hpp"
#include "core/counted.hpp"
#include "model/inside.hpp"
#include "physics/contact/features.glsl"
#include "simulation/near_boxes.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_told = 8;
constexpr double near_enough = 0.99;  // of the gap: places in scenes are rounded

class NearStarts {
 public:
  NearStarts(const Model& model, const State& state, const CollisionDescription& collision)
      : model_(model), collision_(collision), positions_(state.world_positions(model)) {
    for (const ModelBody& body : model.bodies) surfaces_.push_back(surface_of(model, body, collision));
  }

  std::vector<std::string> told() {
    find_near_grounds();
    find_near_bodies();
    if (rest_ > 0)
      told_.push_back(counted(rest_, "more warning", "more warnings") +
                      " of bodies that begin nearer than the gap, or inside another");
    return std::move(told_);
  }

 private:
  void tell(std::string text) {
    if (told_.size() == most_told)
      ++rest_;
    else
      told_.push_back(std::move(text));
  }

  void tell_near(const std::string& who, double distance, double gap) {
    tell(
        fmt::format("{} {:.3g} m apart, nearer than the gap of {:.3g} m that contacts keep: the first step pushes them "
                    "apart, which adds energy; move them further apart",
                    who, distance, gap));
  }

  void tell_enclosed(const ModelBody& inner, const ModelBody& outer) {
    tell(fmt::format("body \"{}\" begins inside body \"{}\", and contacts keep it there; move it out if it should not be",
                     inner.name, outer.name));
  }

  // Whether the first box's body has the second box's body inside. They do not intersect, so one vertex tells.
  bool encloses(const IndexedBox& outer, const IndexedBox& inner) const {
    return !model_.bodies[outer.index].is_container && glm::all(glm::lessThan(outer.lower, inner.lower)) &&
           glm::all(glm::lessThan(inner.upper, outer.upper)) &&
           is_enclosed(positions_[model_.bodies[inner.index].first_vertex], model_, model_.bodies[outer.index], positions_);
  }

  void find_near_grounds() {
    for (std::uint32_t b = 0; b < model_.bodies.size(); ++b)
      for (const Ground& ground : model_.grounds)
        if (!model_.bodies[b].is_rigid()) compare(b, ground);
  }

  void compare(std::uint32_t index, const Ground& ground) {
    const ModelBody& body = model_.bodies[index];
    double distance = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : std::span(positions_).subspan(body.first_vertex, body.vertex_count))
      distance = std::min(distance, glm::dot(ground.normal, p) - ground.offset);
    const double gap = physics::gap_above(ground_of(ground, collision_), surfaces_[index]);
    if (distance < near_enough * gap)
      tell_near(fmt::format("body \"{}\" and the ground of {} begin", body.name, ground.where.place), distance, gap);
  }

  void find_near_bodies() {
    std::vector<IndexedBox> boxes;
    double largest_gap = 0, largest_edge = 0;
    for (std::uint32_t b = 0; b < model_.bodies.size(); ++b) {
      const ModelBody& body = model_.bodies[b];
      if (body.triangle_count == 0) continue;
      largest_gap = std::max(largest_gap, surfaces_[b].gap);
      largest_edge = std::max(largest_edge, surfaces_[b].edge);
      IndexedBox& box = boxes.emplace_back(IndexedBox{.index = b});
      for (const glm::dvec3& p : std::span(positions_).subspan(body.first_vertex, body.vertex_count)) box.add(p);
    }
    for_each_near(std::move(boxes), largest_gap * largest_edge, [&](const IndexedBox& a, const IndexedBox& b) { compare(a, b); });
  }

  void compare(const IndexedBox& a, const IndexedBox& b) {
    const ModelBody &first = model_.bodies[a.index], &second = model_.bodies[b.index];
    if (first.is_rigid() && second.is_rigid()) return;
    if (encloses(a, b)) tell_enclosed(second, first);
    if (encloses(b, a)) tell_enclosed(first, second);
    const double gap = physics::gap_of_pair(surfaces_[a.index], surfaces_[b.index]);
    double nearest = near_enough * gap;
    for_each_near_triangles(model_, first, a, second, b, positions_, gap,
                            [&](std::uint32_t s, std::uint32_t t) { nearest = std::min(nearest, distance_of(s, t)); });
    if (nearest < near_enough * gap)
      tell_near(fmt::format("bodies \"{}\" and \"{}\" begin", model_.bodies[std::min(a.index, b.index)].name,
                            model_.bodies[std::max(a.index, b.index)].name),
                nearest, gap);
  }

  double distance_of(std::uint32_t s, std::uint32_t t) const {
    const glm::dvec3 near_by = positions_[model_.triangles[s][0]];
    glm::dvec3 corners[6];
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = positions_[model_.triangles[s][k]] - near_by;
      corners[3 + k] = positions_[model_.triangles[t][k]] - near_by;
    }
    return physics64::closest_points(corners).distance;
  }

  const Model& model_;
  const CollisionDescription& collision_;
  std::vector<glm::dvec3> positions_;
  std::vector<physics::Surface> surfaces_;
  std::vector<std::string> told_;
  std::size_t rest_ = 0;  // texts beyond those told
};

}  // namespace

std::vector<std::string> told_near_starts(const Model& model, const State& state, const CollisionDescription& collision) {
  return NearStarts(model, state, collision).told();
}

}  // namespace pliant
