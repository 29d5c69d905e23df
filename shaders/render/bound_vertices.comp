#version 450
// Finds the boxes around vertices that cast shadows, so that the maps of light can follow them. A vertex matters for the picture's
// light if the camera sees it, or a place that it may shade.
#include "drawable.glsl"
#include "studio.glsl"
#include "surface.glsl"
#include "light_axes.glsl"
layout(local_size_x = 64) in;
layout(location = 1) uniform uint vertex_count;

const float farthest = 5.0;  // in distances to what the camera looks at: shadows farther away are small

/// Whether the picture shows the place, or what is behind it in the light, down to the ground. In clip space the light's way is a line,
/// and each side of the picture bounds the part of it that is seen.
bool may_shade(vec3 place) {
  vec4 p = view_projection * vec4(place, 1.0), way = view_projection * vec4(-key_direction.xyz, 0.0);
  float depth = farthest * distance(eye.xyz, target.xyz);
  float inside[5] = float[5](p.w + p.x, p.w - p.x, p.w + p.y, p.w - p.y, depth - p.w);
  float change[5] = float[5](way.w + way.x, way.w - way.x, way.w + way.y, way.w - way.y, -way.w);
  vec2 part = vec2(0.0, ground.w > 0.0 ? max(place.y - ground.y, 0.0) / key_direction.y : 1e4 * centre.w);  // [m]
  for (int i = 0; i < 5; ++i) {
    float crossing = -inside[i] / change[i];
    if (change[i] > 0.0)
      part.x = max(part.x, crossing);
    else if (change[i] < 0.0)
      part.y = min(part.y, crossing);
    else if (inside[i] < 0.0)
      return false;
  }
  return part.x <= part.y;
}

// Most vertices change nothing, so they only look.
void add(uint box, vec3 place) {
  for (int k = 0; k < 3; ++k) {
    uint at = ordered(place[k]), low = box + k, high = box + 3 + k;
    if (at < bounds[low]) atomicMin(bounds[low], at);
    if (at > bounds[high]) atomicMax(bounds[high], at);
  }
}

void main() {
  mat3 axes = light_axes();
  uint threads = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  for (uint i = gl_GlobalInvocationID.x; i < vertex_count; i += threads) {
    vec3 place = place_of(i);
    if (!is_drawable(place)) continue;
    add(whole_box, place);
    if (may_shade(place)) add(lit_box, place * axes);
  }
}
