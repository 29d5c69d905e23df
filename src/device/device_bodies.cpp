// Upload and download of model and state.
#include "device/device_bodies.hpp"

namespace pliant {
namespace {

std::vector<physics::Body> bodies_of(const Model& model) {
  std::vector<physics::Body> bodies;
  for (const ModelBody& body : model.bodies)
    bodies.push_back({body.stiffness, body.vertex_mass, body.damping, body.first_vertex, body.vertex_count});
  return bodies;
}

std::vector<glm::vec4> rounded_world_positions(const Model& model, const State& state) {
  std::vector<glm::vec4> rounded;
  for (const glm::dvec3& position : state.world_positions(model)) rounded.emplace_back(glm::vec3(position), 1.0f);
  return rounded;
}

physics::Control first_control() {
  physics::Control control{};
  control.step = 1;
  control.non_finite_vertex = physics::no_vertex;
  for (auto* groups : {control.turn_groups, control.refresh_groups, control.refit_groups, control.find_groups,
                       control.test_groups, control.respond_groups})
    groups[1] = groups[2] = 1;
  return control;
}

}  // namespace

DeviceBodies::DeviceBodies(Device& device, const Model& model, const State& state)
    : vertex_count(model.vertex_count()),
      body_count(static_cast<std::uint32_t>(model.bodies.size())),
      bodies(device, bodies_of(model), "bodies"),
      frames(device, state.frames, "frames"),
      rest_positions(device, model.rest_positions, "rest positions"),
      motions(device, std::size_t{12} * vertex_count, "motions"),
      world_positions(device, std::size_t{2} * vertex_count, "world positions"),
      body_boxes(device, std::size_t{6} * body_count, "body boxes"),
      control(device, std::vector{first_control()}, "control") {
  motions.upload(state.motion);
  world_positions.upload(rounded_world_positions(model, state));
}

void DeviceBodies::clear_boxes() {
  std::vector<std::uint32_t> boxes;
  for (std::uint32_t b = 0; b < body_count; ++b) boxes.insert(boxes.end(), {~0u, ~0u, ~0u, 0u, 0u, 0u});
  body_boxes.upload(boxes);
}

State DeviceBodies::download(std::uint32_t half) const {
  return {.frames = frames.download(),
          .motion = motions.download(std::size_t{6} * half * vertex_count, std::size_t{6} * vertex_count)};
}

}  // namespace pliant
