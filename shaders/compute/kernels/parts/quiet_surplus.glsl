// What contact by impulses expects of motions, in a quiet step.
#include "kept_surplus.glsl"

shared Surplus found_surplus[3 * VERTICES * TEAMS];  // after this step, of the share's coordinates, along axes of the world

void find_surplus(Share s) {
  EACH_KEPT(n) {
    uint i = VERTEX_OF(n), k = AXIS_OF(n), b = s.body_index;
    dvec3 mean = way_in_frame(i) / step_length;
    found_surplus[n] = kept_surplus_after(i, k, in_world(b, k, mean - velocity_in(before_step(i))),
                                          in_world(b, k, velocity_in(after_step(i)) - mean));
  }
}

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then.
void look_at_vertex(uint i, uint k, uint b, double surplus_after) {
  double along = in_world(b, k, way_in_frame(i)), room = double(bounds.room), h = step_length;
  double expected = h * (in_world(b, k, velocity_in(before_step(i))) + h * kept_surplus(i, k).expected);
  double speed = in_world(b, k, velocity_in(after_step(i))) + h * surplus_after;
  bool stays = along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
  stays = stays && abs(along - expected) <= double(bounds.surprise);
  bool goes_on = speed > double(bounds.least_velocity[k]) && speed < double(bounds.most_velocity[k]);
  if (!stays) take_back_step();
  if (!goes_on) end_with_step();
}

void look_at_vertices(Share s) {
  find_surplus(s);
  EACH_KEPT(n) look_at_vertex(VERTEX_OF(n), AXIS_OF(n), s.body_index, found_surplus[n].expected);
}

void keep_surplus(Share s) {
  EACH_KEPT(n) store_surplus(VERTEX_OF(n), AXIS_OF(n), found_surplus[n]);
}
