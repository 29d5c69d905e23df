#include "physics/collision/moller_triangles.glsl"

#include <catch2/catch.hpp>

#include "collision/contacts/degenerate_cases.hpp"

namespace pliant::testing {
namespace {

bool moller(const Triangle& a, const Triangle& b) {
  const glm::vec3 p[3] = {a[0], a[1], a[2]}, q[3] = {b[0], b[1], b[2]};
  return physics::triangles_intersect_moller(p, q);
}

Triangle scaled(Triangle triangle, float factor) {
  for (glm::vec3& corner : triangle) corner *= factor;
  return triangle;
}

const Triangle flat{glm::vec3(0, 0, 0), glm::vec3(8, 0, 0), glm::vec3(0, 8, 0)};
const Triangle piercing{glm::vec3(7, 4, 4), glm::vec3(8, -3, -4), glm::vec3(-5, -3, 0)};
const Triangle above{glm::vec3(1, 1, 0.5f), glm::vec3(7, 1, 3), glm::vec3(1, 7, 3)};

}  // namespace

TEST_CASE("Möller's test answers generic and coplanar cases in any order") {
  int cases = 0;
  for (const TrianglePair& pair : triangle_pairs()) {
    const bool plain = pair.category == "generic" || pair.category == "coplanar";
    if (!plain || (pair.touch == false && relative_gap(pair.a, pair.b) < 1e-5)) continue;
    INFO(pair.id);
    for_every_order(pair.a, pair.b, [&](const Triangle& a, const Triangle& b) { CHECK(moller(a, b) == pair.touch); });
    ++cases;
  }
  CHECK(cases > 10);
}

// Why it is not the default: distances below 1e-6 count as zero, and they are multiplied by an area.
TEST_CASE("Möller's test misses contacts of small triangles and reports others that are not there") {
  CHECK(moller(flat, piercing));
  CHECK_FALSE(moller(scaled(flat, 0.002f), scaled(piercing, 0.002f)));
  CHECK_FALSE(moller(flat, above));
  CHECK(moller(scaled(flat, 1e-5f), scaled(above, 1e-5f)));
}

}  // namespace pliant::testing
