// Textures, framebuffers and vertex arrays.
#include "gl/targets.hpp"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "gl/allocation.hpp"

namespace pliant::gl {
namespace {

[[noreturn]] void refuse(const glm::uvec2& size, std::string_view label, const std::string& why) {
  throw Error(ErrorKind::device, "GPU memory",
              fmt::format("the texture \"{}\" has {} x {} pixels: {}", label, size.x, size.y, why),
              "ask for a smaller picture: output.size, or --size");
}

void expect_within_limit(const glm::uvec2& size, std::string_view label) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (std::max(size.x, size.y) > static_cast<GLuint>(limit))
    refuse(size, label, fmt::format("the driver allows {} a side", limit));
}

void expect_samples(const TextureOptions& options, std::string_view label) {
  GLint most = 1;
  glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, options.format, GL_SAMPLES, 1, &most);
  if (options.samples > 1 && options.samples > most)
    throw Error(ErrorKind::device, std::string(label),
                fmt::format("it needs {} samples a pixel, the driver allows {}", options.samples, most), "choose another GPU");
}

bool has_room_for(GLuint texture, const TextureOptions& options) {
  const Allocation allocation;
  const auto width = static_cast<GLsizei>(options.size.x), height = static_cast<GLsizei>(options.size.y);
  if (options.samples > 1)
    glTextureStorage2DMultisample(texture, options.samples, options.format, width, height, GL_TRUE);
  else
    glTextureStorage2D(texture, options.levels, options.format, width, height);
  return !allocation.ran_out();
}

void set_sampling(GLuint texture, const TextureOptions& options) {
  const GLint between_levels = options.blends_levels ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST;
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, options.levels > 1 ? between_levels : GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const GLfloat outside[4] = {options.outside, options.outside, options.outside, options.outside};
  glTextureParameterfv(texture, GL_TEXTURE_BORDER_COLOR, outside);
}

}  // namespace

Texture::Texture(const TextureOptions& options, std::string_view label) : size_(options.size) {
  expect_within_limit(size_, label);
  expect_samples(options, label);
  glCreateTextures(options.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &id_);
  if (!has_room_for(id_, options)) {
    glDeleteTextures(1, &id_);
    refuse(size_, label, "there is no room for it");
  }
  if (options.samples == 1) set_sampling(id_, options);
  set_label(GL_TEXTURE, id_, label);
}

Texture::~Texture() { glDeleteTextures(1, &id_); }

Framebuffer::Framebuffer(const Texture* color, const Texture* depth, std::string_view label)
    : size_(color != nullptr ? color->size() : depth->size()) {
  glCreateFramebuffers(1, &id_);
  set_label(GL_FRAMEBUFFER, id_, label);
  if (color != nullptr) glNamedFramebufferTexture(id_, GL_COLOR_ATTACHMENT0, color->id(), 0);
  if (depth != nullptr) glNamedFramebufferTexture(id_, GL_DEPTH_ATTACHMENT, depth->id(), 0);
  if (color == nullptr) glNamedFramebufferDrawBuffer(id_, GL_NONE);
  if (glCheckNamedFramebufferStatus(id_, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  glDeleteFramebuffers(1, &id_);
  throw Error(ErrorKind::device, std::string(label), "the driver cannot draw into this format", "update the graphics driver");
}

Framebuffer::~Framebuffer() { glDeleteFramebuffers(1, &id_); }

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, static_cast<GLsizei>(size_.x), static_cast<GLsizei>(size_.y));
}

VertexArray::VertexArray() { glCreateVertexArrays(1, &id_); }

VertexArray::VertexArray(const Buffer& indices) {
  glCreateVertexArrays(1, &id_);
  glVertexArrayElementBuffer(id_, indices.id());
  glEnableVertexArrayAttrib(id_, 0);
  glVertexArrayAttribFormat(id_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(id_, 0, 0);
}

void VertexArray::take_positions(std::uint32_t buffer, std::uint32_t first_vertex) const {
  constexpr GLsizei stride = 4 * sizeof(GLfloat);
  glVertexArrayVertexBuffer(id_, 0, buffer, GLintptr{first_vertex} * stride, stride);
}

VertexArray::~VertexArray() { glDeleteVertexArrays(1, &id_); }

}  // namespace pliant::gl
