// Bounds the length of the step. Needs the array `step_parts`.
void bound_step(double longest) {
  if (longest < step_parts[0].full) atomicMin(step_parts[0].longest, floatBitsToUint(float(longest)));
}

// What has this speed goes no further than `most` [m].
void bound_speed(double speed, double most) {
  if (speed * step_parts[0].full > most) bound_step(most / speed);
}
