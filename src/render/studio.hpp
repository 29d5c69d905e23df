// Places the key light and the camera. The GPU says what the maps of light and shadow cover (place_maps.comp).
#pragma once
#include "../../shaders/render/studio.glsl"
#include "render/frame_renderer.hpp"

namespace pliant::render {

/// Returns a studio without what the GPU sets, and without the camera's part, which see_from sets. The key light stands behind
/// the camera's left shoulder.
[[nodiscard]] Studio studio_for(const RenderOptions& options);

/// Sets the camera's part of the studio. `options.size` is the picture's size.
void see_from(Studio& studio, const RenderOptions& options);

}  // namespace pliant::render
