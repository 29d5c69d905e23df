// What frame.glsl knows, in a quiet step, and what else a group has at hand. Other groups write it between steps, so the group fetches it
// once a step.
shared Pose frame;  // but for the quaternion
shared double first_motion[motion_size];
shared QuietBounds bounds;
shared double step_length;  // [s]

// For a step from this half on. Threads load side by side, some of them the same.
void fetch_body(uint b, uint half_index) {
  uint n = gl_LocalInvocationID.x, m = min(n, motion_size - 1u), k = min(n, 2u);
  if (n >= 9u) return;
  frame.rotation[n] = pose[b].rotation[n];
  first_motion[m] = quiet_body[b].first_motion[motion_size * half_index + m];
  frame.origin[k] = pose[b].origin[k];
  frame.gravity[k] = pose[b].gravity[k];
  frame.reference[k] = quiet_body[b].reference[3u * half_index + k];
  bounds.lower[k] = quiet_body[b].bounds.lower[k];
  bounds.upper[k] = quiet_body[b].bounds.upper[k];
  bounds.least_velocity[k] = quiet_body[b].bounds.least_velocity[k];
  bounds.most_velocity[k] = quiet_body[b].bounds.most_velocity[k];
  bounds.room = quiet_body[b].bounds.room;
  bounds.surprise = quiet_body[b].bounds.surprise;
}

// A group may be a step ahead of another that fetches, so each half has its own.
void tell_reference(uint b, uint k, double reference) {
  pose[b].reference[k] = reference;
  quiet_body[b].reference[3u * other_half(from_half) + k] = reference;
}

double gravity_of(uint b, uint k) { return frame.gravity[k]; }
double origin_of(uint b, uint k) { return frame.origin[k]; }
double first_displacement(uint first_vertex, uint k) { return first_motion[k]; }
double first_velocity(uint first_vertex, uint k) { return first_motion[3u + k]; }
double in_world(uint b, uint k, dvec3 p) {
  return row_times(frame.rotation[3u * k], frame.rotation[3u * k + 1u], frame.rotation[3u * k + 2u], p);
}
