#include "bench/contact/apart.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "model/inside.hpp"

namespace pliant::bench {
namespace {

using Corners = std::array<glm::dvec3, 3>;

struct Triangle {
  Corners corners;
  glm::dvec3 lower, upper;
  std::uint32_t body;
};

Triangle triangle_of(const Model& model, std::span<const glm::dvec3> positions, std::size_t t) {
  const auto& [a, b, c] = model.triangles[t];
  Triangle made{.corners = {positions[a], positions[b], positions[c]}, .lower = {}, .upper = {}, .body = model.body_index(a)};
  made.lower = glm::min(glm::min(positions[a], positions[b]), positions[c]);
  made.upper = glm::max(glm::max(positions[a], positions[b]), positions[c]);
  return made;
}

bool boxes_overlap(const auto& a, const auto& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

struct Box {
  glm::dvec3 lower{1e300}, upper{-1e300};
};

std::vector<Box> boxes_of(const Model& model, std::span<const glm::dvec3> positions) {
  std::vector<Box> boxes;
  for (const ModelBody& body : model.bodies) {
    Box& box = boxes.emplace_back();
    for (const glm::dvec3& p : positions.subspan(body.first_vertex, body.vertex_count)) {
      box.lower = glm::min(box.lower, p);
      box.upper = glm::max(box.upper, p);
    }
  }
  return boxes;
}

bool may_touch_another(const Triangle& triangle, const std::vector<Box>& boxes) {
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (b != triangle.body && boxes_overlap(triangle, boxes[b])) return true;
  return false;
}

// Each coordinate of p, relative to a corner, is off by 2^-53 of itself. A shadow (3 products, 2 sums) is then off by at most
// 4 * 2^-53 of sum |axis_k| |p_k|, and a gap of two shadows by twice that and its own rounding.
bool is_apart_on(const glm::dvec3& axis, const std::array<glm::dvec3, 6>& p) {
  double least[2] = {1e300, 1e300}, most[2] = {-1e300, -1e300}, size = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double shadow = glm::dot(axis, p[k]);
    least[k / 3] = std::min(least[k / 3], shadow);
    most[k / 3] = std::max(most[k / 3], shadow);
    size = std::max(size, glm::dot(glm::abs(axis), glm::abs(p[k])));
  }
  return std::max(least[0] - most[1], least[1] - most[0]) > 16 * 0x1p-53 * size;
}

bool is_apart(const Corners& a, const Corners& b) {
  std::array<glm::dvec3, 6> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = a[k] - a[0];
    p[3 + k] = b[k] - a[0];
  }
  const auto edge = [&](std::size_t k) { return k < 3 ? p[(k + 1) % 3] - p[k] : p[3 + (k + 1) % 3] - p[k]; };
  if (is_apart_on(glm::cross(edge(0), edge(1)), p) || is_apart_on(glm::cross(edge(3), edge(4)), p)) return true;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 3; k < 6; ++k)
      if (is_apart_on(glm::cross(edge(j), edge(k)), p)) return true;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 3; k < 6; ++k)
      if (is_apart_on(p[j] - p[k], p)) return true;
  return is_apart_on({1, 0, 0}, p) || is_apart_on({0, 1, 0}, p) || is_apart_on({0, 0, 1}, p);
}

// Whether every edge belongs to two triangles or more.
bool is_closed(const Model& model, const ModelBody& body) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(model.triangles[t][k], model.triangles[t][(k + 1) % 3])];
  return !edges.empty() && std::ranges::none_of(edges, [](const auto& edge) { return edge.second == 1; });
}

}  // namespace

ApartOracle::ApartOracle(const Model& model) : model_(model) {
  for (const ModelBody& body : model.bodies) is_closed_.push_back(is_closed(model, body));
}

std::size_t ApartOracle::pairs_not_apart(std::span<const glm::dvec3> positions) const {
  const std::vector<Box> boxes = boxes_of(model_, positions);
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < model_.triangles.size(); ++t)
    if (const Triangle made = triangle_of(model_, positions, t); may_touch_another(made, boxes)) triangles.push_back(made);
  std::ranges::sort(triangles, {}, [](const Triangle& t) { return t.lower.x; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size() && triangles[j].lower.x <= triangles[i].upper.x; ++j)
      if (triangles[i].body != triangles[j].body && boxes_overlap(triangles[i], triangles[j]) &&
          !is_apart(triangles[i].corners, triangles[j].corners))
        ++count;
  return count;
}

std::size_t ApartOracle::vertices_inside_others(std::span<const glm::dvec3> positions) const {
  const std::vector<Box> boxes = boxes_of(model_, positions);
  std::size_t count = 0;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const ModelBody& body = model_.bodies[b];
    const auto& [lower, upper] = boxes[b];
    if (!is_closed_[b]) continue;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (i >= body.first_vertex && i < body.first_vertex + body.vertex_count) continue;
      if (glm::any(glm::lessThan(positions[i], lower)) || glm::any(glm::greaterThan(positions[i], upper))) continue;
      if (is_inside(positions[i], model_, body, positions)) ++count;
    }
  }
  return count;
}

bool ApartOracle::have_parted(std::span<const glm::dvec3> positions) const {
  const std::vector<Box> boxes = boxes_of(model_, positions);
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (boxes_overlap(boxes[a], boxes[b])) return false;
  return true;
}

std::vector<glm::dvec3> between(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, double part) {
  std::vector<glm::dvec3> there;
  for (std::size_t i = 0; i < from.size(); ++i) there.push_back(from[i] + part * (to[i] - from[i]));
  return there;
}

}  // namespace pliant::bench
