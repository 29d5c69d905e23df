// Dear ImGui as the panel and the start page use it: one context at a time, drawn by OpenGL, with the viewer's looks. Only they
// and this file know Dear ImGui.
#pragma once
#include <glm/vec2.hpp>

namespace pliant::view {

/// Make and end Dear ImGui's context. Texts are `text_height` pixels high on a usual display, and everything is `scale` times as
/// large as there. Need a current gl::Context.
void begin_style(float scale, float text_height);
void end_style();
/// Begin a picture of this size [pixels], `seconds` after the last one, and draw it into the window.
void begin_picture(const glm::uvec2& size, double seconds);
void end_picture();

}  // namespace pliant::view
