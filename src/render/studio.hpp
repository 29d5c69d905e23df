// The set that bodies stand in: where the key light is, and what the maps of light and shadow cover.
#pragma once
#include "../../shaders/render/studio.glsl"
#include "render/frame_renderer.hpp"

namespace pliant::render {

/// All but the camera's part. The key light stands behind the camera's left shoulder.
[[nodiscard]] Studio studio_for(const RenderOptions& options);

/// The camera's part; `options.size` is the picture's.
void see_from(Studio& studio, const RenderOptions& options);

}  // namespace pliant::render
