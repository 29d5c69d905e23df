#include "render/line_overlay.hpp"

#include <glad/gl.h>

namespace pliant::render {

void LineOverlay::draw(std::span<const LineEnd> ends, const CameraDescription& camera, const glm::uvec2& size) {
  if (ends.empty()) return;
  if (ends_.size() < ends.size_bytes()) ends_ = gl::Buffer(2 * ends.size_bytes(), "ends of lines");
  ends_.write(0, std::as_bytes(ends));
  const glm::mat4 to_clip(view_projection(camera, static_cast<double>(size.x) / size.y));
  glViewport(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y));
  glUseProgram(program_.id());
  glProgramUniformMatrix4fv(program_.id(), 0, 1, GL_FALSE, &to_clip[0].x);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, ends_.id());
  glBindVertexArray(no_vertices_.id());
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);  // FrameRenderer leaves GL_MAX behind
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(ends.size()));
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
  glUseProgram(0);
}

}  // namespace pliant::render
