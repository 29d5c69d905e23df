// Owning handles for what a picture is drawn into: textures, framebuffers and vertex arrays. All need a current Context.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

#include "gl/objects.hpp"

namespace pliant::gl {

struct TextureOptions {
  std::uint32_t format = 0;    // a sized internal format
  glm::uvec2 size{1, 1};       // [pixels]
  int levels = 1;              // mipmaps and the texture itself
  bool blends_levels = false;  // whether a lookup between two levels gives a mix of both, or the nearer one
  int samples = 1;             // over 1: multisampled, without mipmaps
  float outside = 0;           // what sampling outside of the texture gives
};

/// A 2D texture with linear filtering. Throws Error (device) if it is beyond the driver's largest size or most samples, or if the
/// GPU has no room for it.
class Texture {
 public:
  Texture(const TextureOptions& options, std::string_view label);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] glm::uvec2 size() const { return size_; }

 private:
  std::uint32_t id_ = 0;
  glm::uvec2 size_;
};

/// Draws into textures, which must outlive it. One of them may be null. Throws Error (device) if the driver can't draw into them.
class Framebuffer {
 public:
  Framebuffer(const Texture* color, const Texture* depth, std::string_view label);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  /// Makes it the target of drawing, over its whole size.
  void bind() const;
  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  std::uint32_t id_ = 0;
  glm::uvec2 size_;
};

/// Draws triangles over a buffer of positions, which are attribute 0, a vec3.
class VertexArray {
 public:
  /// Has no indices and positions. Shaders take what they need from storage buffers.
  VertexArray();
  /// `indices` must outlive this.
  explicit VertexArray(const Buffer& indices);
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  /// Takes positions from the xyz of `buffer`, a GL buffer of vec4, from `first_vertex` on.
  void take_positions(std::uint32_t buffer, std::uint32_t first_vertex) const;
  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  std::uint32_t id_ = 0;
};

}  // namespace pliant::gl
