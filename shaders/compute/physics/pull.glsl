// Pulling a body at a part of its surface, between steps: what the threads of a pull know.
#ifndef PULL_GLSL
#define PULL_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Aim {
  double target[3];       // where the grip is to be [m]
  double approach;        // of the way there, how much it should make in a second [1/s]
  double largest_speed;   // with which it should [m/s]
  double largest_change;  // of a velocity by this pull [m/s]
  double change[3];       // of a velocity at full weight, in the body's frame [m/s]: what aim_pull finds
  uint body;
  uint grip_count;        // vertices
};

struct GripVertex {
  uint vertex;
  float weight;  // above 0, at most 1
};

const uint grip_sample_count = 64u;  // vertices of a grip that stand for it, or all if they are fewer

// `v`, shortened to `largest` if it is longer.
FN dvec3 limited(dvec3 v, double largest) {
  double squared = dot(v, v);
  return squared > largest * largest ? v * (largest / sqrt(squared)) : v;
}

SHARED_END
#endif
