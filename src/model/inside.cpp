#include "model/inside.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace pliant {
namespace {

// The solid angle of a triangle as seen from a point. A. Van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126.
double solid_angle(const glm::dvec3& from, const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
  const glm::dvec3 a = p - from, b = q - from, c = r - from;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

// The part of all directions that the body's triangles fill as seen from the point.
double filled(const glm::dvec3& point, const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  double sum = 0;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& [a, b, c] = model.triangles[t];
    sum += solid_angle(point, positions[a], positions[b], positions[c]);
  }
  return std::abs(sum) / (4 * std::numbers::pi);
}

}  // namespace

bool is_inside(const glm::dvec3& point, const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  return filled(point, model, body, positions) > 0.5;
}

bool is_enclosed(const glm::dvec3& point, const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  return filled(point, model, body, positions) > 0.99;
}

}  // namespace pliant
