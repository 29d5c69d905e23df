// What all drawing shaders share of one picture: camera, key light and ground. GLSL and C++ read the same declaration. It has matrices
// and vec4 alone, because std140 and glm lay these out alike. Places are relative to the scene's centre, so that a scene far from the
// origin is drawn as finely as any.
#ifndef STUDIO_GLSL
#define STUDIO_GLSL
#ifdef __cplusplus
  #include <glm/mat4x4.hpp>
  #include <glm/vec4.hpp>
namespace pliant::render {
using glm::mat4, glm::vec4;
struct Studio {
#else
  #ifndef STUDIO_BLOCK
    #define STUDIO_BLOCK layout(std140, binding = 0) uniform
  #endif
STUDIO_BLOCK Studio {
#endif
  mat4 view_projection;   // to clip space
  mat4 from_clip;         // and back
  // place_maps.comp sets these four, and x, z and w of the ground, for each picture.
  mat4 key_projection;    // to the clip space of the key light's shadow map
  mat4 above_projection;  // to the footprint: the map of the ground from above, depth 0 at the ground, 1 at the ceiling
  vec4 lit;               // xyz: centre of what the maps of light cover [m], w: its radius [m]
  vec4 pool;              // x, z: where the ground is brightest [m], w: radius of the scene around [m]
  vec4 eye;               // xyz [m], w: pixels of the picture's height for a slope of 1
  vec4 target;            // xyz: what the camera looks at [m]
  vec4 key_direction;     // xyz: unit vector towards the light
  vec4 centre;            // xyz: of the scene, in the world [m], w: its radius [m]
  vec4 ground;            // x, z: centre of the ground's maps [m], y: height [m], w: half the maps' side [m], 0 without ground
};
const int sample_count = 4;          // of a pixel
const float depth_per_width = 1.5f;  // of the box that the shadow map covers
const float full_strain = 0.3f;      // where the scale of colours ends
const float ceiling = 4.0f;          // of the footprint above the ground, in radii of what is lit
#ifdef __cplusplus
}  // namespace pliant::render
#endif
#endif
