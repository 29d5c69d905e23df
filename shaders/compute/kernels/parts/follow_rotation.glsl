// Turns a body's frame after the body. The kernel has count_frame_change(b).
#include "frame_change.glsl"

// Of the vertices that stand for the body, because any rotation near its own is good enough: their rest positions, and where they are in
// the frame, relative to a point that moves with the body.
// In sums over samples, before about_means(), products are not yet about the means, and means are still sums.
struct Samples {
  dvec3 rest_mean;
  dvec3 moved_mean;
  dvec3 correlation_x;  // sum of (moved - moved_mean) (rest - rest_mean).x, in the next two with .y and .z
  dvec3 correlation_y;
  dvec3 correlation_z;
};

double place_of_sample(double rest, double displacement, double origin) {
  EXACT double place = rest + (displacement - origin);
  return place;
}

// From sums over all samples.
Samples about_means(Samples s) {
  const double part = double(1) / double(sample_count);  // a power of two
  s.rest_mean *= part;
  EXACT dvec3 about_x = s.correlation_x - s.rest_mean.x * s.moved_mean;
  EXACT dvec3 about_y = s.correlation_y - s.rest_mean.y * s.moved_mean;
  EXACT dvec3 about_z = s.correlation_z - s.rest_mean.z * s.moved_mean;
  s.correlation_x = about_x;
  s.correlation_y = about_y;
  s.correlation_z = about_z;
  s.moved_mean *= part;
  return s;
}

// Returns the turn [rad] that reduces the samples' misfit to the rest shape turned by q. The method is from Mueller and others (2016),
// "A robust method to extract the rotational part of deformations".
dvec3 remaining_turn(IN(Samples) s, Quaternion q) {
  dvec3 x = rotate_by(q, dvec3(1, 0, 0)), y = rotate_by(q, dvec3(0, 1, 0)), z = rotate_by(q, dvec3(0, 0, 1));
  EXACT dvec3 torque = ordered_cross(x, s.correlation_x) + ordered_cross(y, s.correlation_y) + ordered_cross(z, s.correlation_z);
  EXACT double alignment = ordered_dot(x, s.correlation_x) + ordered_dot(y, s.correlation_y) + ordered_dot(z, s.correlation_z);
  EXACT dvec3 turn = torque / (abs(alignment) + double(1e-30));
  return turn;
}

void change_frame_of(uint b, uint first_vertex, Quaternion q, dvec3 rest_mean, dvec3 moved_mean) {
  Quaternion old = quaternion(pose[b].quaternion[0], pose[b].quaternion[1], pose[b].quaternion[2], pose[b].quaternion[3]);
  Quaternion next = normalized(product(old, q));
  Quaternion back = conjugate(q);
  dvec3 shift = rotate_by(back, moved_mean) - rest_mean;
  dvec3 origin = LOAD3(pose[b].origin, 0u) + rotate_by(next, shift);
  dvec3 gravity = rotate_by(back, LOAD3(pose[b].gravity, 0u));
  STORE3(pose[b].origin, 0u, origin)
  STORE3(CHANGE_OF(b).shift, 0u, shift)
  STORE3(pose[b].gravity, 0u, gravity)
  pose[b].quaternion[0] = next.x;
  pose[b].quaternion[1] = next.y;
  pose[b].quaternion[2] = next.z;
  pose[b].quaternion[3] = next.w;
  for (uint column = 0u; column < 3u; ++column) {
    dvec3 unit = dvec3(double(column == 0u), double(column == 1u), double(column == 2u));
    dvec3 r = rotate_by(next, unit);
    dvec3 t = rotate_by(back, unit);
    pose[b].rotation[column] = r.x;
    pose[b].rotation[3u + column] = r.y;
    pose[b].rotation[6u + column] = r.z;
    CHANGE_OF(b).turn[column] = t.x;
    CHANGE_OF(b).turn[3u + column] = t.y;
    CHANGE_OF(b).turn[6u + column] = t.z;
  }
  dvec3 first = dvec3(vec3(rest_position[first_vertex]));
  dvec3 reference = rotate_by(back, first + LOAD3(pose[b].reference, 0u)) - first - shift;
  STORE3(pose[b].reference, 0u, reference)
  CHANGE_OF(b).turned = 1u;
  count_frame_change(b);
}

// The frame follows once the body has turned by more than 0.01 rad in it. Displacements then stay small against the body,
// and their rounding to fp32 small against the strains.
bool has_turned(IN(Samples) s) {
  const double largest_turn = double(0.01);
  EXACT dvec3 torque = dvec3(s.correlation_y.z - s.correlation_z.y, s.correlation_z.x - s.correlation_x.z,
                             s.correlation_x.y - s.correlation_y.x);
  EXACT double most = largest_turn * (s.correlation_x.x + s.correlation_y.y + s.correlation_z.z);
  return ordered_dot(torque, torque) > most * most;
}

void follow_rotation(uint b, uint first_vertex, IN(Samples) samples, dvec3 origin) {
  const double smallest_turn = double(1e-9);
  if (!has_turned(samples)) return;
  Quaternion q = quaternion(double(0), double(0), double(0), double(1));
  dvec3 turn = remaining_turn(samples, q);
  for (uint iteration = 0u; iteration < 8u && ordered_dot(turn, turn) > smallest_turn * smallest_turn; ++iteration) {
    Quaternion small = quaternion(turn.x / double(2), turn.y / double(2), turn.z / double(2), double(1));
    q = normalized(product(small, q));
    turn = remaining_turn(samples, q);
  }
  change_frame_of(b, first_vertex, q, samples.rest_mean, samples.moved_mean + origin);
}
