// Draws pictures of a session: its bodies, and lines over them.
#pragma once
#include <glm/vec2.hpp>
#include <optional>

#include "render/drawn_buffers.hpp"
#include "render/frame_renderer.hpp"
#include "render/line_overlay.hpp"
#include "view/look.hpp"
#include "view/marks.hpp"
#include "view/session.hpp"

namespace pliant::view {

/// Needs a current gl::Context while it lives. If the session is on a GPU device, it must be that device's context.
class SceneView {
 public:
  /// `session` must outlive it, and the light is placed for its start. `size` is the size of the first picture [pixels]. Throws
  /// Error (device) if there is no room for it.
  SceneView(Session& session, const glm::uvec2& size, render::Detail detail);

  /// Returns the scene's camera, or one that frames the bodies at the start.
  [[nodiscard]] const CameraDescription& first_camera() const { return options_.camera; }
  /// Returns how high the ground is that pictures show [m], or nothing if they show none.
  [[nodiscard]] const std::optional<double>& ground_height() const { return options_.ground_height; }
  /// Draws the session's current state, whose step the look must name. Draws nothing if the latest picture has the same look.
  /// Throws Error (device) if there is no room for the picture.
  void draw(const Look& wanted);
  /// Copies the latest picture, with its lines, into the window whose context is current.
  void show();
  /// Returns the OpenGL texture of the latest picture without its lines. Its first row is the lowest.
  [[nodiscard]] std::uint32_t picture_texture() const { return renderer_.picture_texture(); }
  /// Returns the latest picture without its lines.
  [[nodiscard]] render::Image picture() const { return renderer_.read(); }

 private:
  [[nodiscard]] std::optional<render::Speeds> speeds(Colors colors);
  [[nodiscard]] Lines lines(const Shows& shows);

  Session& session_;
  render::RenderOptions options_;
  double top_speed_;  // of the colour scale [m/s]
  std::uint64_t bodies_version_;
  render::FrameRenderer renderer_;
  render::DrawnBuffers buffers_;
  std::optional<render::LineOverlay> overlay_;  // made for the first lines
  Lines lines_;                                 // over the latest picture
  std::optional<Look> drawn_;                   // look of the latest picture; empty: there is none
};

}  // namespace pliant::view
