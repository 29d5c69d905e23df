// Owning handles for what a picture is drawn into: textures, framebuffers and vertex arrays. All need a current Context.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

#include "gl/objects.hpp"

namespace pliant::gl {

struct TextureOptions {
  std::uint32_t format = 0;  // a sized internal format
  glm::uvec2 size{1, 1};     // [pixels]
  int levels = 1;
  int samples = 1;              // over 1: multisampled, without mipmaps
  bool compares_depth = false;  // sampled as a shadow map
};

/// A 2D texture: linear filtering, zero (or the far depth) outside. Throws Error (device) beyond the driver's largest size, and
/// when the GPU has no room for it.
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

/// Draws into textures that outlive it; either may be null. Throws Error (device) when the driver can't draw into them.
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

/// A vertex array without attributes: shaders pull what they need from storage buffers.
class VertexArray {
 public:
  /// `indices` may be null and must outlive this.
  explicit VertexArray(const Buffer* indices);
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  std::uint32_t id_ = 0;
};

}  // namespace pliant::gl
