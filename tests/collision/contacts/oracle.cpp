#include "collision/contacts/oracle.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>

#include "core/expect.hpp"
#include "physics/collision/certified_triangles.glsl"
#include "physics/collision/moller_triangles.glsl"

namespace pliant {
namespace {

struct Box {
  glm::vec3 lower{std::numeric_limits<float>::infinity()};
  glm::vec3 upper{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& low, const glm::vec3& high) {
    lower = glm::min(lower, low);
    upper = glm::max(upper, high);
  }
};

struct Triangle {
  std::uint32_t index;  // into Model::triangles
  glm::vec3 corners[3];
  Box box;
};

struct Surface {
  std::vector<Triangle> triangles;
  Box box;
};

bool overlap(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

bool touch(const Triangle& a, const Triangle& b, TriangleTest test) {
  return test == TriangleTest::moller ? physics::triangles_intersect_moller(a.corners, b.corners)
                                      : physics::triangles_may_touch(a.corners, b.corners);
}

Surface gather(const Model& model, const ModelBody& body, std::span<const glm::vec4> positions) {
  Surface surface;
  for (std::uint32_t i = 0; i < body.triangle_count; ++i) {
    Triangle triangle{body.first_triangle + i, {}, {}};
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 corner(positions[model.triangles[triangle.index][static_cast<std::size_t>(k)]]);
      triangle.corners[k] = corner;
      triangle.box.add(corner, corner);
    }
    surface.box.add(triangle.box.lower, triangle.box.upper);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

std::vector<const Triangle*> inside(const Surface& surface, const Box& box) {
  std::vector<const Triangle*> found;
  for (const Triangle& triangle : surface.triangles) {
    if (overlap(triangle.box, box)) found.push_back(&triangle);
  }
  return found;
}

void add_pairs(const Surface& a, const Surface& b, TriangleTest test, std::vector<glm::uvec2>& pairs) {
  const std::vector<const Triangle*> near_a = inside(b, a.box);
  for (const Triangle* first : inside(a, b.box)) {
    for (const Triangle* second : near_a) {
      if (overlap(first->box, second->box) && touch(*first, *second, test)) pairs.emplace_back(first->index, second->index);
    }
  }
}

}  // namespace

std::vector<glm::uvec2> intersecting_pairs(const Model& model, std::span<const glm::vec4> world_positions, TriangleTest test) {
  PLIANT_EXPECT(world_positions.size() == model.rest_positions.size());
  std::vector<Surface> surfaces;
  for (const ModelBody& body : model.bodies) surfaces.push_back(gather(model, body, world_positions));
  std::vector<glm::uvec2> pairs;
  for (std::size_t a = 0; a < surfaces.size(); ++a) {
    for (std::size_t b = a + 1; b < surfaces.size(); ++b) add_pairs(surfaces[a], surfaces[b], test, pairs);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const glm::uvec2& p, const glm::uvec2& q) { return std::pair(p.x, p.y) < std::pair(q.x, q.y); });
  return pairs;
}

}  // namespace pliant
