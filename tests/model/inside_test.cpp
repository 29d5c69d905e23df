#include "model/inside.hpp"

#include <catch2/catch.hpp>

#include "support/evolve.hpp"

namespace pliant {
namespace {

TEST_CASE("a point is inside a cube where each coordinate is, whichever way its triangles are wound") {
  ModelAndState cube = build_model(std::vector{body_of_mesh(generate_mesh("cube:2"))}, glm::dvec3(0.0));
  const std::vector<glm::dvec3> positions = cube.state.world_positions(cube.model);
  for (const bool is_turned : {false, true}) {
    CAPTURE(is_turned);
    for (const double x : {-0.6, -0.4, 0.1, 0.49, 0.51})
      for (const double y : {-0.7, -0.2, 0.3})
        for (const double z : {0.0, 0.45, 0.55})
          CHECK(is_inside({x, y, z}, cube.model, cube.model.bodies[0], positions) ==
                (std::abs(x) < 0.5 && std::abs(y) < 0.5 && std::abs(z) < 0.5));
    for (auto& corners : cube.model.triangles) std::swap(corners[0], corners[1]);
  }
}

}  // namespace
}  // namespace pliant
