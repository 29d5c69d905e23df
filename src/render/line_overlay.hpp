// Draws lines of the world over a picture.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gl/objects.hpp"
#include "gl/targets.hpp"
#include "render/camera.hpp"

namespace pliant::render {

struct LineEnd {
  glm::vec4 place{0.0f};  // xyz [m]
  glm::vec4 color{1.0f};  // sRGB and opacity
};

/// Needs a current gl::Context while it lives.
class LineOverlay {
 public:
  /// Draws a line between the first and second end, another between the third and fourth, and so on. They go into the bound
  /// framebuffer and cover what is there.
  void draw(std::span<const LineEnd> ends, const CameraDescription& camera, const glm::uvec2& size);

 private:
  gl::Program program_ = gl::Program::graphics("render/line.vert", "render/line.frag");
  gl::VertexArray no_vertices_;
  gl::Buffer ends_;
};

}  // namespace pliant::render
