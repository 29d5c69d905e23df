// Pictures of a session: its bodies, and lines over them.
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

/// Needs a current gl::Context while it lives, which is that of any GPU device the session is on.
class SceneView {
 public:
  /// `session` must outlive it; lights are fitted to its start. `size` is that of the first picture [pixels]. Throws Error
  /// (device) when there is no room for it.
  SceneView(Session& session, const glm::uvec2& size, render::Detail detail);

  /// The scene's, or one that frames where it starts.
  [[nodiscard]] const CameraDescription& first_camera() const { return options_.camera; }
  /// Draws the session as it stands, which is at the look's step; nothing where the latest picture looks so. Throws Error
  /// (device) when there is no room for it.
  void draw(const Look& wanted);
  /// Copies the latest picture, with its lines, into the window whose context is current.
  void show();
  /// The latest picture, without its lines.
  [[nodiscard]] render::Image picture() const { return renderer_.read(); }

 private:
  [[nodiscard]] std::optional<render::Speeds> speeds(Colors colors);
  [[nodiscard]] Lines lines(const Shows& shows);

  Session& session_;
  render::RenderOptions options_;
  double top_speed_;  // of the colour scale [m/s]
  render::FrameRenderer renderer_;
  render::DrawnBuffers buffers_;
  std::optional<render::LineOverlay> overlay_;  // once there have been lines
  Lines lines_;                                 // over the latest picture
  std::optional<Look> drawn_;                   // what that is; empty: there is none
};

}  // namespace pliant::view
