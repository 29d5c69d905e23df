#version 450
// Draws coverage (x), and how far below the ceiling the lowest surface lies (y), blended by maximum. Mipmaps average both: the mean
// depth of what covers is 1 - y / x.
layout(location = 0) out vec2 footprint;

void main() { footprint = vec2(1.0, 1.0 - gl_FragCoord.z); }
