#version 450
// Coverage, and how far below the map's ceiling the lowest surface lies; blended by maximum. Both average under mipmaps:
// the mean height of what covers is ceiling - y / x.
#include "studio.glsl"
in float height;
layout(location = 0) out vec2 footprint;

void main() {
  if (height < 0.0) discard;
  footprint = vec2(1.0, max(1.0 - height / (4.0 * centre.w), 0.0));
}
