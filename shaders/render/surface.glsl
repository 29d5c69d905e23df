// The bodies' surfaces, pulled by vertex number from the simulation's own buffer of world positions.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };           // xyz: world [m]
layout(std430, binding = 1) readonly buffer RestPositions { vec4 rest_positions[]; };  // xyz [m]; w: body
layout(std430, binding = 2) readonly buffer FirstIncident { uint first_incident[]; };  // vertices + 1
layout(std430, binding = 3) readonly buffer Incident { uvec2 incident[]; };  // a triangle's other two corners, in winding order
layout(location = 0) uniform uint first_vertex;  // where the positions begin in their buffer

out float gl_ClipDistance[1];

vec3 world_position(uint vertex) { return positions[first_vertex + vertex].xyz; }

/// False for NaN, infinities and what would overflow in a matrix product.
bool is_drawable(vec3 p) { return all(lessThan(abs(p), vec3(1e15))); }

/// Sends a vertex to `clip`, or has its triangles clipped away when it is nowhere.
void place_vertex(vec3 world, vec4 clip) {
  if (is_drawable(world)) {
    gl_Position = clip;
    gl_ClipDistance[0] = 1.0;
  } else {
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    gl_ClipDistance[0] = -1e10;
  }
}
