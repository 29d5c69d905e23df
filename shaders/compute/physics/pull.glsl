// What the threads know that pull a body at a part of its surface, between steps.
#ifndef PULL_GLSL
#define PULL_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Aim {
  double target[3];       // where the grip has to go [m]
  double approach;        // part of the way there that it goes in a second [1/s]
  double largest_speed;   // it goes there no faster [m/s]
  double largest_change;  // this pull changes a velocity by no more [m/s]
  double change[3];       // aim_pull writes the change of velocity at full weight here, in the body's frame [m/s]
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
