#include "render/drawn_buffers.hpp"

#include <string_view>
#include <vector>

#include "device/gpu/gpu_device.hpp"

namespace pliant::render {
namespace {

DrawnBuffer copied(std::span<const std::byte> bytes, gl::Buffer& copy, std::string_view label) {
  if (copy.size() != bytes.size()) copy = gl::Buffer(bytes.size(), label);
  copy.write(0, bytes);
  return {.id = copy.id(), .first_vertex = 0};
}

}  // namespace

DrawnBuffer DrawnBuffers::positions(Device& device, Simulation& simulation) {
  if (gpu::context_of(device) != nullptr)
    return {gpu::gl_buffer_of(device, simulation.position_buffer()), simulation.first_position()};
  const std::vector<glm::vec4> positions = simulation.world_positions();
  return copied(std::as_bytes(std::span(positions)), positions_, "drawn positions");
}

DrawnBuffer DrawnBuffers::motions(Device& device, Simulation& simulation) {
  if (gpu::context_of(device) != nullptr)
    return {gpu::gl_buffer_of(device, simulation.motion_buffer()), simulation.first_position()};
  const State state = simulation.state();
  return copied(std::as_bytes(std::span(state.motion)), motions_, "drawn motions");
}

}  // namespace pliant::render
