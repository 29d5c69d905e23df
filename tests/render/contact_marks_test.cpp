// Contacts as lines over a picture.
#include "render/contact_marks.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "device/cpu/cpu_device.hpp"
#include "device/gpu/gpu_device.hpp"
#include "gl/context.hpp"
#include "render/drawn_buffers.hpp"
#include "render/frame_renderer.hpp"
#include "support/collision_scene.hpp"
#include "support/has.hpp"
#include "support/pictures.hpp"

namespace pliant::render {
namespace {

constexpr double time_step = 0.01;

glm::dvec3 from_to(const Lines& lines, std::size_t line) {
  return glm::dvec3(glm::vec3(lines[2 * line + 1].place - lines[2 * line].place));
}

TEST_CASE("touching vertices have crosses, a tenth of their body's radius wide") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  const std::vector<std::uint32_t> touching{3, static_cast<std::uint32_t>(positions.size() - 1)};
  Lines lines;
  add_touching(lines, start.model, positions, touching);
  REQUIRE(lines.size() == 6 * touching.size());
  for (std::size_t k = 0; k < lines.size(); k += 2) {
    const std::uint32_t vertex = touching[k / 6];
    CHECK(glm::distance(glm::dvec3(lines[k].place + lines[k + 1].place) * 0.5, positions[vertex]) < 1e-6);
    CHECK(glm::distance(lines[k].place, lines[k + 1].place) == Approx(0.1 * start.model.body_of(vertex).radius));
  }
}

TEST_CASE("each body has a line along the impulse that it gets, and the largest is half a radius long") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  const std::uint32_t other = start.model.bodies[1].first_vertex, none = physics::no_vertex;
  const ContactImpulse between{
      .vertex = {0, other, other + 1, other + 2}, .weight = {1, -0.5, -0.25, -0.25}, .impulse = {2, 0, 0}};
  const ContactImpulse on_ground{.vertex = {other + 3, none, none, none}, .weight = {1, 0, 0, 0}, .impulse = {0, 1, 0}};
  Lines lines;
  add_impulses(lines, start.model, positions, std::vector{between, on_ground});
  REQUIRE(lines.size() == 2 * (3 + 2 + 3 + 1));
  const double length = 0.5 * std::min(start.model.bodies[0].radius, start.model.bodies[1].radius);
  CHECK(glm::distance(from_to(lines, 3), glm::dvec3(length, 0, 0)) < 1e-6);
  CHECK(glm::distance(from_to(lines, 4), glm::dvec3(-length, 0, 0)) < 1e-6);
  CHECK(glm::distance(from_to(lines, 8), glm::dvec3(0, length / 2, 0)) < 1e-6);
  CHECK(glm::distance(glm::dvec3(glm::vec3(lines[16].place)), positions[other + 3]) < 1e-6);
}

TEST_CASE("marks of contacts are drawn over a picture, and only where bodies touch", "[gl]") {
  if (test::lacks_gl()) return;
  gl::Context context(0);
  const auto cpu = make_cpu_device(1, 32);
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  for (const char* response : {"reflect", "impulse"}) {
    CAPTURE(response);
    Simulation simulation(*cpu, start.model, start.state, plan_of(Method{"verlet", time_step}), {.response = {response}});
    FrameRenderer renderer(start.model, live_options(start.model, start.state, {}, {160, 120}, Detail::reduced));
    DrawnBuffers buffers;
    const auto marked_and_plain = [&] {
      const DrawnBuffer drawn = buffers.positions(*cpu, simulation);
      renderer.draw(drawn.id, drawn.first_vertex);
      const Image plain = renderer.read();
      Lines lines;
      add_contacts(lines, simulation, start.model, simulation.state().world_positions(start.model));
      renderer.draw_lines(lines);
      return std::pair(renderer.read(), plain);
    };
    const auto [at_start, plain_start] = marked_and_plain();
    CHECK(at_start.pixels == plain_start.pixels);
    while (simulation.report().contact_steps < 3) simulation.advance(1);
    const auto [touching, plain] = marked_and_plain();
    CHECK(touching.pixels != plain.pixels);
  }
}

}  // namespace
}  // namespace pliant::render
