// Needs the arrays `body`, `pose`, `control`, `tally` and `slept`.
// What bears the body takes the momentum of this velocity in the frame, which is summed over vertices.
void note_momentum(uint b, dvec3 velocity) {
  dvec3 in_world = dvec3(row_times(pose[b].rotation[0], pose[b].rotation[1], pose[b].rotation[2], velocity),
                         row_times(pose[b].rotation[3], pose[b].rotation[4], pose[b].rotation[5], velocity),
                         row_times(pose[b].rotation[6], pose[b].rotation[7], pose[b].rotation[8], velocity));
  dvec3 taken = LOAD3(slept, momentum_slept_of(b)) + in_world / body[b].inverse_mass;
  STORE3(slept, momentum_slept_of(b), taken)
}

// What bears the body takes what gravity would give it in the step.
void note_step_asleep(uint b) {
  tally[b].steps_asleep += 1u;
  note_momentum(b, (double(body[b].vertex_count) * control[0].time_step) * LOAD3(pose[b].gravity, 0u));
}
