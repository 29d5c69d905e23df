// A force kernel of stages: the acceleration at this stage, then the placement for the next stage, or the step's end.
// Second-order form: with abar = A A and bbar = b A, x_s = x + c_s h v + h^2 sum abar_sj a_j, so only accelerations are kept.
// A Nystrom method's tableau has the damping in its weights, a body's own; the law is then none.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
READ(0, Shares, Share, share)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
WRITE(5, Accelerations, double, acceleration)   // [stage][vertex][3]; a stage's velocity stands there until its acceleration does
WRITE(6, Motions, double, motion)               // two halves: the state before the step and after it
WRITE(7, WorldPositions, float, world_position)  // two halves likewise
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, damping_law)
#include "parts/stages.glsl"
#include "parts/force_kernel.glsl"
#include "parts/place.glsl"
#include "parts/end_step.glsl"

bool runs(IN(Share) s) { return !halted(s); }
uint placement_slot() { return stage_index == 0u ? start_slot : stage_index & 1u; }

// What a body's vertices have in common on one axis.
struct Course {
  double gravity;
  double reference;        // that the next placement is relative to
  double time_step;        // [s]
  double elapsed;          // from the step's start to the next stage, as far as the first velocity carries [s]
  double keep;             // what is left of that velocity
  double position_weight;  // of this stage's acceleration [s^2]
  double velocity_weight;  // [s]
};

// All that a coordinate needs beside its force. What this stage's acceleration a is to add is missing from the sums.
struct Pending {
  Course course;
  double rest;
  double stage_velocity;  // at this stage
  double displacement;    // for the next stage, or at the end; position_weight a is missing
  double velocity;        // likewise
};

// Where the tableau's row for the next stage begins, or for the end. A row holds that stage's c and keep; then weights for position
// (h^2) and velocity (h), this stage's first, then those of earlier stages in turn, with zeros up to a multiple of four.
uint next_row(IN(Share) s) { return s.tableau_row + stage_index * (2u + ((stage_count + 3u) & ~3u)); }
uint accelerations_of(uint stage, uint i) { return 3u * (stage * vertex_count + i); }

// Earlier stages are summed four at a time, so that their loads overlap. Beyond the last one weights are zero.
double earlier(uint i, uint k, uint j) { return acceleration[accelerations_of(min(j, stage_index - 1u), i) + k]; }
dvec2 weigh_four(uint first, double a, double b, double c, double d) {
  return (a * tableau[first] + b * tableau[first + 1u]) + (c * tableau[first + 2u] + d * tableau[first + 3u]);
}
dvec2 sum_earlier(uint i, uint k, uint row) {  // for position and velocity
  dvec2 sums = dvec2(0);
  for (uint j = 0u; j < stage_index; j += 4u)
    sums += weigh_four(row + 2u + j, earlier(i, k, j), earlier(i, k, j + 1u), earlier(i, k, j + 2u), earlier(i, k, j + 3u));
  return sums;
}

// Whether the velocity for the next stage, or at the end, is used at all.
bool wants_velocity() { return is_last() || damping_law != damping_none; }

Course course_on_axis(uint k, IN(Share) s) {
  uint first = 6u * (from_half * vertex_count + s.body.first_vertex) + k, row = next_row(s);
  Course c;
  c.gravity = frame[s.body_index].gravity[k];
  c.time_step = frame[s.body_index].time_step;
  c.elapsed = tableau[row].x * c.time_step;
  c.keep = tableau[row].y;
  c.reference = motion[first] + c.elapsed * motion[first + 3u];
  c.position_weight = c.time_step * c.time_step * tableau[row + 1u].x;
  c.velocity_weight = c.time_step * tableau[row + 1u].y;
  return c;
}

Pending before_force_with(uint i, uint k, IN(Course) c, dvec2 sums) {
  uint before = 6u * (from_half * vertex_count + i) + k;
  Pending p;
  p.course = c;
  p.rest = double(rest_position[i][int(k)]);
  p.stage_velocity = motion[before + 3u];
  if (damping_law != damping_none && stage_index > 0u) p.stage_velocity = acceleration[accelerations_of(stage_index, i) + k];
  p.displacement = motion[before] + c.elapsed * motion[before + 3u] + (c.time_step * c.time_step) * sums.x;
  p.velocity = c.keep * motion[before + 3u] + c.time_step * sums.y;
  return p;
}

Pending before_force(uint i, uint k, IN(Share) s) {
  return before_force_with(i, k, course_on_axis(k, s), sum_earlier(i, k, next_row(s)));
}

double after_force(uint i, uint k, IN(Share) s, double spring_force, double force_squared, IN(Pending) p) {
  double a = spring_force * s.body.inverse_mass + p.course.gravity;
  if (damping_law != damping_none)
    a -= damping_rate(damping_law, s.body.damping, s.body.inverse_mass, force_squared) * p.stage_velocity;
  acceleration[accelerations_of(stage_index, i) + k] = a;
  double displacement = p.displacement + p.course.position_weight * a;
  double velocity = p.velocity + p.course.velocity_weight * a;
  place(is_last() ? start_slot : (stage_index + 1u) & 1u, i, k, s.body.inverse_unit, p.rest, displacement - p.course.reference);
  if (is_last())
    end_step(i, k, s, displacement, velocity, p.course.reference);
  else if (damping_law != damping_none)
    acceleration[accelerations_of(stage_index + 1u, i) + k] = velocity;
  return p.rest + displacement;
}

bool settles() { return is_last(); }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) { end_in_world(i, k, s.body_index, position); }
