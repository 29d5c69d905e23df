// How bodies fly. A cluster is bodies that owe for motions cut short, and those near them that were at a cut.
// - None of a cluster can pay with its own rigid motion, because that would change momentum. Together they can: what their rigid motions
//   have beyond that of all of them as one keeps both momenta if it is scaled. If one of them was cut short in the world, they also pay
//   with that of all.
// - In the next step cuts leave the cluster's motion alone. Otherwise what is held back would stay behind while all the others fly on.
//   Each place goes straight to where a rotation and a shift take it. At any time between that is one affine map of space, so triangles
//   that make nothing but this motion stay apart.
// - A scripted body has such a flight, too, along its path. It makes no motion beside that.
// - Cuts leave the velocity of an island alone, too, so that they do not depend on how fast all fly along. An island is bodies whose boxes
//   are within an edge of each other, from one to the next.
#ifndef CLUSTER_GLSL
#define CLUSTER_GLSL
#include "../rigid_motion.glsl"
#include "debt.glsl"
SHARED_BEGIN

struct Cluster {
  // Of a cluster, at its first body. A scripted body has `motion` alone.
  Moments sum;         // over its bodies' vertices, times their masses, about the first body's first vertex, in the world
  RigidMotion motion;  // of all its vertices together, in the world [m], [m/s], [1/s]
  Means means;         // of the cluster as one body, whose deformation is what its bodies' rigid motions have beyond `motion`
  double mass;         // [kg]

  // Of an island, at its first body. Those of a body alone stand at the body until islands are known.
  double island_velocity[3];  // of its bodies by their masses, at the step's start, in the world [m/s]
  uint cannot_fly;            // 1: it does not move, or one of its bodies breaks apart
  uint is_disturbed;          // 1: one moves, or may be reached by one that does
  uint is_restless;           // 1: one has not been fit to sleep for long enough
  uint is_borne;              // 1: what does not move presses one
  uint is_beside_static;      // 1: one has a cage that meets a static triangle or comes near a ground, so it has no flight

  uint first;        // the first body of the cluster of the body with this number
  uint island;       // the first body of its island
  uint is_stirred;   // 1: in this step one of its vertices went too fast to sleep or was cut short, or one from beyond its island came near
  uint has_company;  // 1: its island has other bodies, too; behind the last body: some island has
  uint bodies;       // of the cluster
  uint is_held;      // 1: one of the cluster's bodies was cut short in the world
  uint moves_as_one; // 1: it is a scripted body, or a cluster, whose flight is `motion`; behind the last body: some are
};

SHARED_END
#endif
