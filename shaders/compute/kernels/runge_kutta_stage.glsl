// A force kernel of stages. It finds the acceleration at this stage. Then it writes the placement for the next stage, or the step's end.
// The second-order form keeps accelerations alone: x_s = x + c_s h v + h^2 sum abar_sj a_j. Here abar is A A, for the step's end b A.
// The tableau of a Nystrom method has a body's own damping in its weights. The law is then none.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
#include "../physics/layout.glsl"
READ(share)
READ(control)
WRITE(status)
READ(rest_position)
WRITE(acceleration)
WRITE_AS(world_position, float, world_coordinate)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, damping_law)
#include "parts/stages.glsl"
#include "parts/force_kernel.glsl"
#include "parts/place.glsl"
#include "parts/all_force.glsl"
#include "parts/end_step.glsl"

bool runs(IN(Share) s) { return !halted(s); }

// Where a body is not deformed all stages have one acceleration, because the adaptive law does not damp it, either. In quiet steps nobody
// asks for those of earlier stages, so the last one is enough.
#ifdef QUIET
bool has_one_acceleration = false;
uint first_stage(IN(Share) s, bool sums) {
  has_one_acceleration = !sums && (damping_law != damping_constant || s.body.damping == double(0));
  return has_one_acceleration ? stage_count - 1u : 0u;
}
#else
const bool has_one_acceleration = false;
#ifdef TILE
uint first_stage(IN(Share) s, bool sums) { return 0u; }
#endif
#endif
uint placement_slot() { return slot_of_stage(stage_index); }

// What a body's vertices have in common on one axis.
struct Course {
  double gravity;
  double reference;        // the next placement is relative to this displacement [m]
  double time_step;        // [s]
  double elapsed;          // weight of the first velocity in the next stage's position: without drag the time since the start [s]
  double keep;             // what is left of that velocity
  double position_weight;  // of this stage's acceleration [s^2]
  double velocity_weight;  // [s]
};

// What rounding placements does to forces would add up over stages and steps like a random walk. Within a step it is made to cancel.
// What the stages so far have rounded is taken off the next placement. A stage counts by its weight in the velocity at the end.
// The step's first stage is left out, and what the last one rounds remains, because their weights are small. The sums stand in
// `rounding_slot`, if the frame around says CANCELS_ROUNDING.
struct Rounding {
  real of_position;
  real of_displacement;
};

// All that a coordinate needs beside its force. The sums lack what this stage's acceleration a adds.
struct Pending {
  Course course;
  Rounding rounding;      // so far
  double rest;
  double stage_velocity;  // at this stage
  double displacement;    // for the next stage, or at the end, without position_weight a [m]
  double velocity;        // for the next stage, or at the end, without velocity_weight a [m/s]
};

// Where the tableau's row for the next stage begins, or for the end.
uint next_row(IN(Share) s) { return s.tableau_row + stage_index * tableau_row_size(stage_count); }
uint accelerations_of(uint stage, uint i) { return acceleration_of(stage, vertex_count, i); }

// Earlier stages are summed four at a time, so that their loads overlap. Beyond the last one weights are zero.
double earlier(uint i, uint k, uint j, double gravity) {
  return has_one_acceleration ? gravity : acceleration[accelerations_of(min(j, stage_index - 1u), i) + k];
}
dvec2 weigh_four(uint first, double a, double b, double c, double d) {
  EXACT dvec2 sum = (a * tableau[first] + b * tableau[first + 1u]) + (c * tableau[first + 2u] + d * tableau[first + 3u]);
  return sum;
}
dvec2 sum_earlier(uint i, uint k, uint row, double gravity) {  // for position and velocity
  dvec2 sums = dvec2(0);
  for (uint j = 0u; j < stage_index; j += 4u)
    sums += weigh_four(row + first_earlier_weight + j, earlier(i, k, j, gravity), earlier(i, k, j + 1u, gravity),
                       earlier(i, k, j + 2u, gravity), earlier(i, k, j + 3u, gravity));
  return sums;
}

// Whether the velocity for the next stage, or at the end, is used at all.
bool wants_velocity() { return is_last() || damping_law != damping_none; }

Course course_on_axis(uint k, IN(Share) s) {
  uint first = s.body.first_vertex, row = next_row(s);
  Course c;
  c.gravity = gravity_of(s.body_index, k);
  c.time_step = control[0].time_step;
  c.elapsed = tableau[row].x * c.time_step;
  c.keep = tableau[row].y;
  EXACT double reference = first_displacement(first, k) + c.elapsed * first_velocity(first, k);
  c.reference = reference;
  c.position_weight = c.time_step * c.time_step * tableau[row + 1u].x;
  c.velocity_weight = c.time_step * tableau[row + 1u].y;
  return c;
}

Rounding rounding_so_far(uint i, uint k) {
  Rounding rounding;
  rounding.of_position = rounding.of_displacement = real(0);
  if (!CANCELS_ROUNDING || stage_index == 0u || is_last()) return rounding;
  rounding.of_position = placement[number_of(position_at(rounding_slot, vertex_count, i), k)];
  rounding.of_displacement = placement[number_of(displacement_at(rounding_slot, vertex_count, i), k)];
  return rounding;
}

// Rounds a coordinate for the next stage, and notes what that has done. `weight` holds the next stage's weight in the velocity at the
// end, and its reciprocal.
void place_against(real so_far, dvec2 weight, double exact, uint at, uint noted_at) {
  real rounded = real(FUSED(-double(so_far), weight.y, exact));
  placement[at] = rounded;
  placement[noted_at] = real(FUSED(weight.x, double(rounded) - exact, double(so_far)));
}

void place_next(uint i, uint k, double inverse_unit, double rest, double relative, IN(Rounding) so_far, dvec2 weight) {
  uint slot = slot_after_stage(stage_index);
  place_against(so_far.of_position, weight, inverse_unit * (rest + relative), number_of(position_at(slot, vertex_count, i), k),
                number_of(position_at(rounding_slot, vertex_count, i), k));
  place_against(so_far.of_displacement, weight, inverse_unit * relative, number_of(displacement_at(slot, vertex_count, i), k),
                number_of(displacement_at(rounding_slot, vertex_count, i), k));
}

Pending before_force_with(uint i, uint k, IN(Course) c, dvec2 sums) {
  uint before = in_half(from_half, vertex_count, i), u = displacement_of(before) + k, w = velocity_of(before) + k;
  Pending p;
  p.course = c;
  p.rounding = rounding_so_far(i, k);
  p.rest = double(rest_position[i][int(k)]);
  p.stage_velocity = motion[w];
  if (damping_law != damping_none && stage_index > 0u && !has_one_acceleration)
    p.stage_velocity = acceleration[accelerations_of(stage_index, i) + k];
  EXACT double displacement = motion[u] + c.elapsed * motion[w] + (c.time_step * c.time_step) * sums.x;
  EXACT double velocity = c.keep * motion[w] + c.time_step * sums.y;
  p.displacement = displacement;
  p.velocity = velocity;
  return p;
}

Pending before_force(uint i, uint k, IN(Share) s) {
  Course c = course_on_axis(k, s);
  return before_force_with(i, k, c, sum_earlier(i, k, next_row(s), c.gravity));
}

struct Damping {
  double rate;  // [1/s]
};

Damping damping_by(IN(Share) s, double force_squared) {
  Damping d;
  d.rate = damping_rate(damping_law, s.body.damping, s.body.inverse_mass, force_squared);
  return d;
}

double after_force(uint i, uint k, IN(Share) s, double spring_force, IN(Damping) d, IN(Pending) p) {
  EXACT double undamped = all_force(i, k, spring_force) * s.body.inverse_mass + p.course.gravity;
  EXACT double damped = undamped - d.rate * p.stage_velocity;
  double a = damping_law != damping_none ? damped : undamped;
  acceleration[accelerations_of(stage_index, i) + k] = a;
  EXACT double displacement = p.displacement + p.course.position_weight * a;
  EXACT double velocity = p.velocity + p.course.velocity_weight * a;
  double relative = displacement - p.course.reference;
  if (CANCELS_ROUNDING && !is_last())
    place_next(i, k, s.body.inverse_unit, p.rest, relative, p.rounding, tableau[next_row(s) + 2u]);
  else
    place(is_last() ? start_slot : slot_after_stage(stage_index), i, k, s.body.inverse_unit, p.rest, relative);
  if (is_last())
    end_step(i, k, s, displacement, velocity, p.course.reference);
  else if (damping_law != damping_none)
    acceleration[accelerations_of(stage_index + 1u, i) + k] = velocity;
  return p.rest + displacement;
}

bool settles() { return is_last(); }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) { end_in_world(i, k, s.body_index, position); }
