// What contact by impulses expects of motions, in a quiet step.
#include "../../physics/contact/surplus.glsl"
WRITE(surplus)

// Along axis k of the world [m/s].
double surplus_of_end(uint i, uint k, uint b) {
  return in_world(b, k, velocity_in(after_step(i)) - way_in_frame(i) / control[0].time_step);
}
double surplus_expected_next(uint i, uint k, uint b) {
  double of_start = in_world(b, k, way_in_frame(i) / control[0].time_step - velocity_in(before_step(i)));
  return expected_surplus(of_start, surplus_of_end(i, k, b), surplus[end_surplus_of(vertex_count, i) + k]);
}

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then.
void look_at_vertex(uint i, uint k, uint b) {
  double along = in_world(b, k, way_in_frame(i)), room = double(bounds.room);
  double expected = control[0].time_step * (in_world(b, k, velocity_in(before_step(i))) + surplus[expected_surplus_of(i) + k]);
  double speed = in_world(b, k, velocity_in(after_step(i))) + surplus_expected_next(i, k, b);
  bool stays = along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
  bool goes_on = speed > double(bounds.least_velocity[k]) && speed < double(bounds.most_velocity[k]);
  if (!stays) atomicMin(quiet_steps[0].undone, step_index);
  if (!goes_on) atomicMin(quiet_steps[0].end, step_index + 1u);
}

void keep_surplus(uint i, uint k, uint b) {
  surplus[expected_surplus_of(i) + k] = surplus_expected_next(i, k, b);
  surplus[end_surplus_of(vertex_count, i) + k] = surplus_of_end(i, k, b);
}
