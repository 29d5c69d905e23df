#version 450
// Coverage, and how far below the ceiling the lowest surface lies; blended by maximum. Both average under mipmaps: the mean
// depth of what covers is 1 - y / x.
layout(location = 0) out vec2 footprint;

void main() { footprint = vec2(1.0, 1.0 - gl_FragCoord.z); }
