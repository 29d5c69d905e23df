#version 450
// One thread says what the maps of light cover: the scene's start while bodies are in it, else where the bodies that matter for the
// picture are. Sizes go by steps and places by whole texels, so that shadows do not shimmer where the maps follow bodies.
#define STUDIO_BLOCK layout(std140, binding = 3) buffer
#include "studio.glsl"
#include "light_axes.glsl"
layout(local_size_x = 1) in;

const float margin = 1.15;  // of the shadow map around what is lit
const float smallest_part = 0.25;  // of the start's radius: what is smaller is lit by finer maps
const float steps = 4.0;  // of size, from one to its double

struct Box {
  bool is_empty;
  vec3 low, high;
};

vec3 corner_at(uint first) { return vec3(value_of(bounds[first]), value_of(bounds[first + 1u]), value_of(bounds[first + 2u])); }

Box box_at(uint first) { return Box(bounds[first] > bounds[first + 3u], corner_at(first), corner_at(first + 3u)); }

/// Returns centre and radius of what is lit, along the light's axes. What is beyond the map towards the light still casts its shadow, so
/// only the farthest from the light has to be in the map's depths.
vec4 lit_part(Box box) {
  vec3 start = margin * centre.w * vec3(1.0, 1.0, depth_per_width);
  vec2 half_sides = 0.5 * (box.high.xy - box.low.xy);
  float needed = max(half_sides.x, half_sides.y);
  bool is_in_start = all(greaterThan(box.low, -start)) && all(lessThan(vec3(box.high.xy, box.low.z), start));
  if (box.is_empty || (is_in_start && needed > smallest_part * centre.w)) return vec4(0.0, 0.0, 0.0, centre.w);
  float radius = centre.w * exp2(ceil(steps * log2(max(1.05 * needed / centre.w, 1e-6))) / steps);
  vec2 middle = 0.5 * (box.low.xy + box.high.xy);
  float grid = radius * margin / 16.0;  // 32 texels
  return vec4(round(middle / grid) * grid, min(0.5 * (box.low.z + box.high.z), box.low.z + radius), radius);
}

/// Places relative to the centre of what is lit come from -1 to 1 across the map.
mat4 key_projection_of(mat3 axes, vec4 part) {
  float side = 1.0 / (margin * part.w), depth = side / depth_per_width;
  mat3 turn = transpose(mat3(axes[0] * side, axes[1] * side, axes[2] * -depth));
  return mat4(vec4(turn[0], 0.0), vec4(turn[1], 0.0), vec4(turn[2], 0.0), vec4(-part.xyz * vec3(side, side, -depth), 1.0));
}

/// The maps of the ground lie under what is lit and reach out to where its shadows fall.
void place_on_ground() {
  vec2 away = key_direction.xz * ((ground.y - lit.y) / key_direction.y);
  float half_side = max(2.2 * lit.w, 0.5 * length(away) + 1.6 * lit.w);
  ground.xz = lit.xz + 0.5 * away;
  if (lit.xyz != vec3(0.0)) {
    half_side = ceil(half_side / lit.w * steps) / steps * lit.w;
    float grid = half_side / 4.0;  // 32 texels, because mipmaps have texels of their own
    ground.xz = round(ground.xz / grid) * grid;
  }
  ground.w = half_side;
  // The map's depth runs from the ground up to the ceiling. The world's z is the map's y.
  float side = 1.0 / half_side, height = 2.0 / (ceiling * lit.w);
  above_projection = mat4(vec4(side, 0.0, 0.0, 0.0), vec4(0.0, 0.0, height, 0.0), vec4(0.0, side, 0.0, 0.0),
                          vec4(-side * ground.x, -side * ground.z, -height * ground.y - 1.0, 1.0));
}

/// The ground is bright around the start, and out to the farthest body.
vec4 pool_around(Box box) {
  float farthest = length(max(abs(box.low), abs(box.high))), more = 0.5 * (farthest - centre.w);
  if (box.is_empty || !(more > 0.0)) return vec4(0.0, 0.0, 0.0, centre.w);
  vec2 middle = 0.5 * (box.low.xz + box.high.xz);
  vec2 moved = middle * min(1.0, more / max(length(middle), 1e-30));
  return vec4(moved.x, 0.0, moved.y, centre.w + more);
}

void main() {
  mat3 axes = light_axes();
  vec4 part = lit_part(box_at(lit_box));
  lit = vec4(axes * part.xyz, part.w);
  pool = pool_around(box_at(whole_box));
  key_projection = key_projection_of(axes, part);
  if (ground.w > 0.0) place_on_ground();
  for (uint k = 0u; k < 3u; ++k) {  // empty for the next picture
    bounds[lit_box + k] = bounds[whole_box + k] = 0xffffffffu;
    bounds[lit_box + 3u + k] = bounds[whole_box + 3u + k] = 0u;
  }
}
