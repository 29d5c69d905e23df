// Sums over a part of a body's vertices, for what bodies pay (kernels/pay_dues.glsl) and for impacts (kernels/restore_impacts.glsl).
#ifndef PART_SUMS_GLSL
#define PART_SUMS_GLSL
#include "../rigid_motion.glsl"
SHARED_BEGIN

// What happened to motions in a step, as bits: some were cut short, or those of what they would have met. Some were cut short in the world,
// because their island has no flight.
const uint cut_short_bit = 1u;
const uint at_a_cut_bit = 2u;
const uint held_bit = 4u;

// What a body has to do with motions that are cut short. Bodies that belong together have one that owes.
const uint not_involved = 0u;
const uint involved = 1u;  // it or what it would have met was cut short in this step, and it owes nothing for cuts
const uint owing = 2u;

struct PartSums {
  Moments moments;
  double lost_turning[3];  // what cuts took from the sum of x cross w, less that of all at cuts together [m^2/s]
  double deformation;      // kinetic energy of the velocities less the rigid motion [J]
  double rigid;            // kinetic energy of the rigid motion, with the spin that cuts took [J]
  double missed;           // the part of it that cuts kept from moving anything [J]
  double gained;           // energy that cuts added to springs, and that the returned spin adds [J]
  uint cuts;               // bits, as above
  uint involvement;        // of the body: only its first part has it
  uint parts_too_fast;     // 1: the body parts from another one faster than their restitution lets them; only its first part has it
  uint padding;
};

SHARED_END
#endif
