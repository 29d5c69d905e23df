// What contact by impulses expects of motions, in a quiet step.
#include "kept_surplus.glsl"

// After this step, along axis k of the world.
Surplus surplus_after_step(uint i, uint k, uint b) {
  dvec3 mean = way_in_frame(i) / control[0].time_step;
  return kept_surplus_after(i, k, in_world(b, k, mean - velocity_in(before_step(i))), in_world(b, k, velocity_in(after_step(i)) - mean));
}

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then.
void look_at_vertex(uint i, uint k, uint b) {
  double along = in_world(b, k, way_in_frame(i)), room = double(bounds.room);
  double h = control[0].time_step;
  double expected = h * (in_world(b, k, velocity_in(before_step(i))) + h * kept_surplus(i, k).expected);
  double speed = in_world(b, k, velocity_in(after_step(i))) + h * surplus_after_step(i, k, b).expected;
  bool stays = along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
  bool goes_on = speed > double(bounds.least_velocity[k]) && speed < double(bounds.most_velocity[k]);
  if (!stays) take_back_step();
  if (!goes_on) end_with_step();
}

void keep_surplus(uint i, uint k, uint b) { store_surplus(i, k, surplus_after_step(i, k, b)); }
