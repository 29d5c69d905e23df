// How bodies fly. A cluster is bodies that owe for motions cut short, and those near them that were at a cut.
// - None of a cluster can pay with its own rigid motion, because that would change momentum. Together they can: what their rigid motions have
//   beyond that of all of them as one keeps both momenta if it is scaled. If one of them was cut short in the world, beside what does not
//   move, they also pay with that of all.
// - In the next step cuts leave the cluster's motion alone. Otherwise what is held back would stay behind while all the others fly on.
//   Each place goes straight to where a rotation and a shift take it. At any time between that is one affine map of space, so triangles
//   that make nothing but this motion stay apart.
// - Cuts leave the mean velocity of other bodies alone, too, so that they do not depend on how fast all fly along. A body and those near it
//   have one in common.
#ifndef CLUSTER_GLSL
#define CLUSTER_GLSL
#include "../rigid_motion.glsl"
#include "debt.glsl"
SHARED_BEGIN

struct Cluster {
  Moments sum;         // over its bodies' vertices, times their masses, about the first body's first vertex, in the world
  RigidMotion motion;  // of all its vertices together, in the world [m], [m/s], [1/s]
  Means means;         // what its bodies' rigid motions can pay of what their deformations could not. They deform it beyond its own motion
  double mass;         // [kg]
  uint first;          // its first body, where these sums stand
  uint bodies;
  uint is_held;        // 1: one of its bodies was cut short in the world

  // Of a cluster, and of the body with this number if it is in none.
  uint is_low;            // 1: its flight is not used in this step, because it is near a ground
  uint is_beside_static;  // the same, because it is near a body that does not move

  // Of that body.
  uint least_flight[3];  // mean velocities of it and of those near it, in the world [m/s], as bits that order as floats do
  uint most_flight[3];   // its flight is between both. None if it is below the least
};

SHARED_END
#endif
