// Bodies coloured by what they go through.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "gl/context.hpp"
#include "gl/objects.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

/// From a published sRGB colour to the linear one that a body's description wants.
glm::dvec3 linear(const glm::dvec3& srgb) { return {std::pow(srgb.x, 2.2), std::pow(srgb.y, 2.2), std::pow(srgb.z, 2.2)}; }

}  // namespace

TEST_CASE("bodies at rest are coloured by speed as undeformed ones by deformation, and faster ones otherwise", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer motions(2 * 6 * subject.world.size() * sizeof(double), "motions");  // at rest, and as fast as the scale goes
  std::vector<double> moving(6 * subject.world.size(), 0.0);
  for (std::size_t i = 0; i < subject.world.size(); ++i) moving[6 * i + 4] = 3;
  motions.write(moving.size() * sizeof(double), std::as_bytes(std::span(moving)));
  Drawing drawing(subject);
  const auto picture = [&](const std::optional<Speeds>& speeds) {
    drawing.renderer.set_speeds(speeds);
    return drawing.picture().pixels;
  };
  const auto plain = picture({});
  const auto resting = picture(Speeds{motions.id(), 0, 3}), fast = picture(Speeds{motions.id(), subject.model.vertex_count(), 3});
  CHECK((fast != resting && fast != plain && resting != plain));
  CHECK((picture({}) == plain));
  drawing.renderer.set_coloring(Coloring::deformation);
  CHECK((picture({}) == resting));
}

TEST_CASE("with colours of deformation a body at rest has the scale's first colour all over, wherever it is", "[gl]") {
  const gl::Context context(0);
  RenderOptions deformation = without_ground();
  deformation.coloring = Coloring::deformation;
  const glm::dvec3 first_of_viridis(0.267, 0.005, 0.329);
  const Image expected = draw(sphere({0.5, 0.2, -1}, linear(first_of_viridis)));
  CHECK(largest_difference(draw(sphere({0.5, 0.2, -1}), deformation), expected) <= 6);
}

TEST_CASE("with colours of deformation a body stretched by 30 % everywhere has the scale's last colour", "[gl]") {
  const gl::Context context(0);
  RenderOptions deformation = without_ground();
  deformation.coloring = Coloring::deformation;
  const glm::dvec3 last_of_viridis(0.993, 0.906, 0.144);
  const Image expected = draw(scaled(sphere({0, 0, 0}, linear(last_of_viridis)), 1.3f));
  CHECK(largest_difference(draw(scaled(sphere({0, 0, 0}), 1.3f), deformation), expected) <= 12);
}
