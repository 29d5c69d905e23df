// What contact by impulses expects of motions, in a quiet step.
WRITE(surplus)

// What `settle` keeps of a step for the next: the velocity that the vertex had in the step beyond that at the start, in the frame [m/s].
dvec3 surplus_in_frame(uint i, dvec3 gone) { return gone / control[0].time_step - velocity_in(before_step(i)); }

// A step does not stand that might have moved a vertex out of its cage. It is the last one if the vertex may leave its bounds then.
void look_at_vertex(uint i, uint k, uint b) {
  dvec3 gone = way_in_frame(i);
  double latest = surplus[surplus_of(0u, vertex_count, i) + k], oldest = surplus[surplus_of(1u, vertex_count, i) + k];
  double along = in_world(b, k, gone), next = in_world(b, k, surplus_in_frame(i, gone)), room = double(bounds.room);
  double expected =
      control[0].time_step * (in_world(b, k, velocity_in(before_step(i))) + (latest + double(0.5) * (latest - oldest)));
  double speed = in_world(b, k, velocity_in(after_step(i))) + (next + double(0.5) * (next - latest));
  bool stays = along < max(expected, double(0)) + room && along > min(expected, double(0)) - room;
  bool goes_on = speed > double(bounds.least_velocity[k]) && speed < double(bounds.most_velocity[k]);
  if (!stays) atomicMin(quiet_steps[0].undone, step_index);
  if (!goes_on) atomicMin(quiet_steps[0].end, step_index + 1u);
}

void keep_surplus(uint i, uint k, uint b) {
  double next = in_world(b, k, surplus_in_frame(i, way_in_frame(i)));
  surplus[surplus_of(1u, vertex_count, i) + k] = surplus[surplus_of(0u, vertex_count, i) + k];
  surplus[surplus_of(0u, vertex_count, i) + k] = next;
}
