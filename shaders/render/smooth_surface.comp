#version 450
// One thread finds one vertex's smooth normal and its local strain, or its speed in place of strain. The normal is the sum of the
// normals of the vertex's triangles, weighted by area.
#include "drawable.glsl"
#include "studio.glsl"
#include "surface.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 2) readonly buffer FirstIncident { uint first_incident[]; };  // vertices + 1
layout(std430, binding = 3) readonly buffer Incident { uvec2 incident[]; };  // a triangle's other two corners, in winding order
layout(std430, binding = 4) writeonly buffer Smooth {
  vec4 smooth_surface[];  // xyz: normal, w: strain, the mean of |length / rest length - 1| over the edges of the triangles
};
layout(std430, binding = 5) readonly buffer Motions { double motion[]; };  // 6 a vertex: displacement, velocity [m/s]
layout(location = 1) uniform uint vertex_count;
layout(location = 2) uniform uint first_motion;         // of vertex 0
layout(location = 3) uniform float strain_of_speed;     // shows a speed of 1 m/s like this strain [s/m], 0: shows strains, reads no motions

float edge_strain(uint a, uint b) {
  float rest_length = distance(rest_positions[a].xyz, rest_positions[b].xyz);
  return rest_length > 0.0 ? abs(distance(place_of(a), place_of(b)) / rest_length - 1.0) : 0.0;
}

float speed_of(uint vertex) {
  uint at = 6u * (first_motion + vertex) + 3u;
  return length(vec3(motion[at], motion[at + 1u], motion[at + 2u]));
}

void main() {
  uint vertex = gl_GlobalInvocationID.x;
  if (vertex >= vertex_count) return;
  vec3 place = place_of(vertex), normal = vec3(0.0);
  float strains = 0.0;
  uint begin = first_incident[vertex], end = first_incident[vertex + 1u];
  for (uint i = begin; i < end; ++i) {
    uvec2 other = incident[i];
    vec3 area = cross(place_of(other.x) - place, place_of(other.y) - place);
    if (!is_drawable(area)) continue;
    normal += area;
    strains += edge_strain(vertex, other.x) + edge_strain(vertex, other.y) + edge_strain(other.x, other.y);
  }
  float shown = strain_of_speed > 0.0 ? strain_of_speed * speed_of(vertex) : strains / max(3.0 * float(end - begin), 1.0);
  smooth_surface[vertex] = vec4(normal / max(length(normal), 1e-30), shown);
}
