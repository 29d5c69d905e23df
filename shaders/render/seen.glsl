// What the samples of the picture see: which triangle, and how deep. Also where a pixel's ray meets that triangle.
// Neither map is cleared for each picture. A picture's depths lie in a slice of their own, before those of earlier pictures.
layout(binding = 2) uniform usampler2DMS triangles_seen;  // counted from 1, but from earlier pictures if deeper than the slice
layout(binding = 4) uniform sampler2DMS depths;
layout(location = 2) uniform vec2 depth_slice;  // where it begins, and its width

/// How deep sample i sees: from 0 to 1 in the slice, 1 if it sees nothing.
float depth_at(ivec2 pixel, int i) { return min((texelFetch(depths, pixel, i).x - depth_slice.x) / depth_slice.y, 1.0); }

/// The triangle that sample i sees, counted from 1, or 0 for none.
uint triangle_at(ivec2 pixel, int i) { return depth_at(pixel, i) < 1.0 ? texelFetch(triangles_seen, pixel, i).x : 0u; }

layout(std430, binding = 5) readonly buffer Triangles { uint corners[]; };  // three each

struct Corners {
  uint vertices[3];
  vec3 a, b, c;  // [m]
};

Corners corners_of(uint seen) {
  uint first = 3u * (seen - 1u);
  uint vertices[3] = uint[3](corners[first], corners[first + 1u], corners[first + 2u]);
  return Corners(vertices, place_of(vertices[0]), place_of(vertices[1]), place_of(vertices[2]));
}

/// The side follows from the winding. The normal is not of unit length.
vec3 face_normal(Corners at) { return cross(at.b - at.a, at.c - at.a); }

/// -1 if the eye sees the triangle's back, else 1, because both sides of an open surface show.
float side_seen(Corners at) { return dot(face_normal(at), eye.xyz - at.a) < 0.0 ? -1.0 : 1.0; }

/// The ray from the eye through a place of the picture (0 to 1 from the bottom left). It is not of unit length.
vec3 ray_through(vec2 place) {
  vec4 far = from_clip * vec4(place * 2.0 - 1.0, 1.0, 1.0);
  return far.xyz / far.w - eye.xyz;
}

/// Weights of the corners where the ray meets the triangle, or at its rim where the ray just misses it.
vec3 weights_at(Corners at, vec3 ray) {
  vec3 ab = at.b - at.a, ac = at.c - at.a, q = cross(eye.xyz - at.a, ray);
  float facing = -dot(ray, face_normal(at));
  vec2 uv = abs(facing) > 1e-30 ? vec2(dot(ac, q), -dot(ab, q)) / facing : vec2(1.0 / 3.0);
  vec3 weights = clamp(vec3(1.0 - uv.x - uv.y, uv), 0.0, 1.0);
  return weights / (weights.x + weights.y + weights.z);
}
