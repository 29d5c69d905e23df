// The bodies' surfaces, from the simulation's own buffer of world positions. Places are relative to the scene's centre (studio.glsl).
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };           // xyz: world [m]
layout(std430, binding = 1) readonly buffer RestPositions { vec4 rest_positions[]; };  // xyz [m], w: body
layout(location = 0) uniform uint first_vertex;  // where the positions begin in their buffer

vec3 place_of(uint vertex) { return positions[first_vertex + vertex].xyz - centre.xyz; }
