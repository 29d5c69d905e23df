// Places the key light, and says what the maps of light and shadow cover.
#pragma once
#include "../../shaders/render/studio.glsl"
#include "render/frame_renderer.hpp"

namespace pliant::render {

/// Returns a studio without the camera's part, which see_from sets. The key light stands behind the camera's left shoulder.
[[nodiscard]] Studio studio_for(const RenderOptions& options);

/// Sets the camera's part of the studio. `options.size` is the picture's size.
void see_from(Studio& studio, const RenderOptions& options);

}  // namespace pliant::render
