// One contact: what it asks of the velocities of its vertices, and the impulse that gives it. A contact lies between a vertex and a
// triangle, between two edges, or between a vertex and a plane. docs/contact.md explains the method.
#ifndef CONTACT_GLSL
#define CONTACT_GLSL
#include "features.glsl"
#include "surface.glsl"
REAL_BEGIN

// Rows in `contact`:
// row 0: the normal, from the second body to the first, and the least change of velocity along it [m/s]
// row 1: the weights of the four vertices, above 0 on the first body and below 0 on the second. Against a ground its number is the last
// row 2: the goal of the change of velocity across the normal [m/s], and the friction, which shrinks while the contact does not settle
// row 3, from the first round on:
//        - what a quantum changes the velocity of a vertex of the first body by, and of the second [m/s]
//        - the mass that resists the contact [kg]
//        - the impulse below which a change in a round does not matter [Ns]. Before the first round it is the contact's settled_speed().
//          After the last one it is below 0 if most_kick_rounds did not settle the contact, and else 0
// row 4: the impulse that the sums of impulses have, which is ahead of the contact's own
// row 5: bounce_of() the contact, and the least impulse along the normal [Ns], which is 0 until impulses have bounced

// Lengths of a pair of bodies [m], and the time step [s].
struct Approach {
  real gap;        // that contacts keep
  real time_step;
  real slowest;    // lost gap comes back no faster than in steps of this length [s]
  real elasticity;
};

// How the points of a contact move against each other along the normal.
struct Course {
  real distance;   // [m]
  real velocity;   // now [m/s]
  real surplus;    // expected: the mean velocity of the coming step is velocity + surplus [m/s]
  real was;        // the mean velocity of the last step [m/s]
  bool was_cut;    // a vertex was held back in the last step
};

// Whether the points come so near that their distance matters in the coming step.
FN bool is_near(IN(Course) c, IN(Approach) a) {
  real enough = real(1.5) * a.gap;
  return c.distance < enough || c.distance + a.time_step * (c.velocity + c.surplus) < enough;
}

// Whether the points rest against each other, so that what held them in the last step holds them in this one.
FN bool rests(IN(Course) c) { return abs(c.was) < abs(c.surplus) || c.was_cut; }

// Whether the points would pass the gap in the step.
FN bool would_pass(IN(Course) c, IN(Approach) a) { return c.distance + a.time_step * (c.velocity + c.surplus) < a.gap; }

// Returns the least velocity along the normal that the contact asks for [m/s]. Points may come as near as the gap. If they would pass it,
// they stop. What has stopped further away comes half-way in a step, or it would hang there. Lost gap comes back slowly, however short
// steps are.
FN real least_velocity(IN(Course) c, IN(Approach) a) {
  real need = (a.gap - c.distance) / a.time_step;
  bool is_far = c.distance >= real(1.5) * a.gap;
  if (c.distance > a.gap && !is_far) need *= real(0.05);
  real nearing = is_far && rests(c) ? real(0.5) * need : real(0);
  real mean = would_pass(c, a) ? max(need, nearing) : need;
  real most = real(0.5) * max(-c.was, real(0)) + real(0.02) * a.gap / max(a.time_step, a.slowest);
  return min(mean, most) - c.surplus;
}

// Returns how many times the impulse that stops its points a contact gives in the end. By Poisson's hypothesis bodies part by the
// elasticity's part of the impulse that stopped them. So contacts that push each other back give far less energy than if each turned its
// own velocity around. Only what stops the velocity now counts, and not what springs press on in the step. Points at rest do not bounce.
// Source: Ch. Glocker and F. Pfeiffer, Multiple impacts with friction in rigid multibody systems (1995).
FN real bounce_of(IN(Course) c, IN(Approach) a) {
  real change = least_velocity(c, a) - c.velocity;
  if (rests(c) || !would_pass(c, a) || c.velocity >= real(0) || change <= real(0)) return real(1);
  real most = real(1) + a.elasticity;
  return clamp(most * -c.velocity / change, real(1), most);
}

// A contact has settled if a round changes its velocity by less than this [m/s]. In a step that is a hundredth of its gap.
FN real settled_speed(IN(Approach) a) { return real(0.01) * a.gap / a.time_step; }

// The part of a vector across the normal.
FN real3 across(IN(real3) normal, IN(real3) v) { return v - dot(normal, v) * normal; }

// Returns the impulse along the normal (x) and across it (yzw) [Ns] after another round. `change` is what impulses so far changed the
// velocity of the points against each other by [m/s], `mass` is what resists them [kg], and `least` the least impulse along the normal.
FN real4 next_impulse(real4 impulse, real4 normal_row, real4 goal_row, IN(real3) change, real mass, real least) {
  real3 normal = real3(normal_row);
  real along = dot(normal, change);
  real4 next;
  next.x = max(least, impulse.x + (normal_row.w - along) * mass);
  // Projected twice: after once, fp32 leaves roundings along the normal.
  real3 friction =
      across(normal, real3(impulse.y, impulse.z, impulse.w) + mass * (real3(goal_row) - (change - along * normal)));
  real size_squared = dot(friction, friction), most = goal_row.w * next.x;
  if (size_squared > most * most) friction *= most / sqrt(size_squared);
  next.y = friction.x;
  next.z = friction.y;
  next.w = friction.z;
  return next;
}

// Returns how far sums go ahead of a contact's impulse after a round from 1 on, in changes of it by that round.
// Source: Y. Nesterov, A method of solving a convex programming problem with convergence rate O(1/k^2) (1983).
FN real momentum_after(uint kick_round) { return real(kick_round - 1u) / real(kick_round + 2u); }

REAL_END
#endif
