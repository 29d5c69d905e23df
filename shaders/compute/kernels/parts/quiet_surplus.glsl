// What contact by impulses expects of motions, in a quiet step.
#include "kept_surplus.glsl"

shared Surplus found_surplus[3 * VERTICES * TEAMS];  // after this step, of the share's coordinates, along axes of the world

// How a vertex went in this step, in the body's frame [m, m/s]. Other groups may write these arrays, so each look at them fetches anew.
struct Gone {
  dvec3 way;
  dvec3 at_start;
  dvec3 at_end;
};

Gone gone_in_step(uint i) {
  Gone g;
  g.way = way_in_frame(i);
  g.at_start = velocity_in(before_step(i));
  g.at_end = velocity_in(after_step(i));
  return g;
}

Surplus surplus_after_step(uint k, uint b, IN(Gone) g, IN(Surplus) before) {
  dvec3 mean = g.way / step_length;
  return kept_surplus_after(before, in_world(b, k, mean - g.at_start), in_world(b, k, g.at_end - mean), step_length);
}

void find_surplus(Share s) {
  EACH_KEPT(n) {
    uint i = VERTEX_OF(n), k = AXIS_OF(n);
    found_surplus[n] = surplus_after_step(k, s.body_index, gone_in_step(i), kept_surplus(i, k));
  }
}

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then.
void look_at_vertex(uint k, uint b, IN(Gone) g, double expected_before, double expected_after) {
  double along = in_world(b, k, g.way), room = double(bounds.room), h = step_length;
  double expected = h * (in_world(b, k, g.at_start) + h * expected_before);
  double speed = in_world(b, k, g.at_end) + h * expected_after;
  bool stays = along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
  stays = stays && abs(along - expected) <= double(bounds.surprise);
  bool goes_on = speed > double(bounds.least_velocity[k]) && speed < double(bounds.most_velocity[k]);
  if (!stays) take_back_step();
  if (!goes_on) end_with_step();
}

void look_at_vertices(Share s) {
  EACH_KEPT(n) {
    uint i = VERTEX_OF(n), k = AXIS_OF(n), b = s.body_index;
    Gone g = gone_in_step(i);
    Surplus before = kept_surplus(i, k), after = surplus_after_step(k, b, g, before);
    found_surplus[n] = after;
    look_at_vertex(k, b, g, before.expected, after.expected);
  }
}

void keep_surplus(Share s) {
  EACH_KEPT(n) store_surplus(VERTEX_OF(n), AXIS_OF(n), found_surplus[n]);
}
