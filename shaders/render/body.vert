#version 450
// A body's vertex with its smooth normal, the sum over its triangles weighted by area, and its local strain.
#include "studio.glsl"
#include "surface.glsl"
layout(std430, binding = 4) readonly buffer BodyColors { vec4 body_colors[]; };

centroid out vec3 world;         // [m]
centroid out vec3 smooth_normal;
centroid out vec3 body_color;
centroid out float strain;       // mean of |length / rest length - 1| over the edges of the vertex's triangles

float edge_strain(uint a, uint b) {
  float rest_length = distance(rest_positions[a].xyz, rest_positions[b].xyz);
  return rest_length > 0.0 ? abs(distance(world_position(a), world_position(b)) / rest_length - 1.0) : 0.0;
}

void main() {
  uint vertex = uint(gl_VertexID);
  world = world_position(vertex);
  vec3 normal = vec3(0.0);
  float strains = 0.0;
  uint begin = first_incident[vertex], end = first_incident[vertex + 1u];
  for (uint i = begin; i < end; ++i) {
    uvec2 other = incident[i];
    vec3 area = cross(world_position(other.x) - world, world_position(other.y) - world);
    if (!is_drawable(area)) continue;
    normal += area;
    strains += edge_strain(vertex, other.x) + edge_strain(vertex, other.y) + edge_strain(other.x, other.y);
  }
  smooth_normal = normal / max(length(normal), 1e-30);
  strain = strains / max(3.0 * float(end - begin), 1.0);
  body_color = body_colors[uint(rest_positions[vertex].w)].rgb;
  place_vertex(world, view_projection * vec4(world, 1.0));
}
