// The path of a scripted body. Between two keys it is a cubic that has the keys' places and rates (Hermite's), in the position and in the
// four numbers of the quaternion, which is then made a rotation. So places and velocities are continuous.
#ifndef PATH_GLSL
#define PATH_GLSL
#include "rotation.glsl"
SHARED_BEGIN

struct PathKey {
  double time;                // [s]
  double position[3];         // [m]
  double velocity[3];         // [m/s]
  double quaternion[4];       // x, y, z, w; the next key's is less than half a turn away
  double quaternion_rate[4];  // [1/s]
};

// How a body goes along its keys, which are a range in the list of all. Before the first key it stands there. Behind the last one it stands
// there, too, or begins anew.
struct Path {
  double drift[3];  // velocity beside that of the keys [m/s]
  double arm[3];    // from the place of a key to the centre of the body's vertices, before the body is turned [m]
  uint first_key;
  uint key_count;   // 0: the body has no path, else two or more
  uint repeats;     // 1: begins anew
  uint padding;
};

// A rigid motion at one time. Places turn about `centre`.
struct PathPoint {
  double centre[3];      // of the body's vertices [m]
  double quaternion[4];  // of the rotation: x, y, z, w
  double velocity[3];    // of the centre [m/s]
  double spin[3];        // [rad/s]
};

// What a run knows of a body on its path.
struct PathState {
  PathPoint now;     // at the step's start
  PathPoint next;    // where the step in hand leads, if nothing stands in its way
  double time;       // of `now` on the body's own clock, which stands while the body waits [s]
  double next_time;  // of `next` [s]
  double pace;       // of that clock, 1 unless the body has just waited
  double waited;     // what the clock is behind [s]
  uint waits;        // steps, or parts of steps, in which it waited
  uint padding;
};

// Rounds once, where a GPU's compiler may take a shorter way.
FN double ratio(double a, double b) {
  EXACT double quotient = a / b;
  return quotient;
}

// A body that waits tries again at half the pace. Otherwise it would hit what it presses as fast in each step. If it goes, its pace grows.
FN double pace_after(double pace, bool waits) {
  return waits ? max(double(0.5) * pace, double(1) / double(1024)) : min(double(1.1) * pace, double(1));
}

// Rates at a part s of the way from one key to the next are over `duration`.
FN double cubic(double from, double to, double rate_from, double rate_to, double s, double duration) {
  double rest = double(1) - s;
  return from + s * s * (double(3) - double(2) * s) * (to - from) + duration * s * rest * (rest * rate_from - s * rate_to);
}
FN double rate_of_cubic(double from, double to, double rate_from, double rate_to, double s, double duration) {
  double rest = double(1) - s;
  return double(6) * s * rest * ratio(to - from, duration) + rest * (double(1) - double(3) * s) * rate_from +
         s * (double(3) * s - double(2)) * rate_to;
}

FN dvec3 cubic(dvec3 from, dvec3 to, dvec3 rate_from, dvec3 rate_to, double s, double duration) {
  return dvec3(cubic(from.x, to.x, rate_from.x, rate_to.x, s, duration), cubic(from.y, to.y, rate_from.y, rate_to.y, s, duration),
               cubic(from.z, to.z, rate_from.z, rate_to.z, s, duration));
}
FN dvec3 rate_of_cubic(dvec3 from, dvec3 to, dvec3 rate_from, dvec3 rate_to, double s, double duration) {
  return dvec3(rate_of_cubic(from.x, to.x, rate_from.x, rate_to.x, s, duration),
               rate_of_cubic(from.y, to.y, rate_from.y, rate_to.y, s, duration),
               rate_of_cubic(from.z, to.z, rate_from.z, rate_to.z, s, duration));
}

// The time at which the keys say where the path is at a time. It lies between the first key's and the last one's.
FN double time_along(IN(Path) path, double time, double first, double last) {
  if (path.repeats != 0u && time > last) time -= floor(ratio(time - first, last - first)) * (last - first);
  return max(first, min(time, last));
}

FN Quaternion quaternion_of(IN(PathPoint) p) { return quaternion(p.quaternion[0], p.quaternion[1], p.quaternion[2], p.quaternion[3]); }

// The turn from one rotation to another by Cayley's map: the axis times the tangent of half the angle.
FN dvec3 half_turn_between(Quaternion from, Quaternion to) {
  Quaternion turn = product(to, conjugate(from));
  return dvec3(ratio(turn.x, turn.w), ratio(turn.y, turn.w), ratio(turn.z, turn.w));
}

// Returns where the path is at a time [s] between two keys. All indices are constants: where one is a loop's, an NVIDIA driver (580) rounds
// what it reads to fp32.
FN PathPoint point_between(IN(PathKey) a, IN(PathKey) b, double time) {
  double duration = b.time - a.time, s = ratio(time - a.time, duration);
  dvec3 place = LOAD3(a.position, 0u), next_place = LOAD3(b.position, 0u), rate = LOAD3(a.velocity, 0u), next_rate = LOAD3(b.velocity, 0u);
  dvec3 q = LOAD3(a.quaternion, 0u), next_q = LOAD3(b.quaternion, 0u);
  dvec3 q_rate = LOAD3(a.quaternion_rate, 0u), next_q_rate = LOAD3(b.quaternion_rate, 0u);
  double w = a.quaternion[3], next_w = b.quaternion[3], w_rate = a.quaternion_rate[3], next_w_rate = b.quaternion_rate[3];
  PathPoint p;
  dvec3 centre = cubic(place, next_place, rate, next_rate, s, duration);
  dvec3 velocity = rate_of_cubic(place, next_place, rate, next_rate, s, duration);
  dvec3 axis = cubic(q, next_q, q_rate, next_q_rate, s, duration);
  dvec3 turning_axis = rate_of_cubic(q, next_q, q_rate, next_q_rate, s, duration);
  double cosine = cubic(w, next_w, w_rate, next_w_rate, s, duration);
  double turning_cosine = rate_of_cubic(w, next_w, w_rate, next_w_rate, s, duration);
  EXACT double size = sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z + cosine * cosine);
  Quaternion at = normalized(quaternion(axis.x, axis.y, axis.z, cosine));
  Quaternion turning = product(quaternion(ratio(turning_axis.x, size), ratio(turning_axis.y, size), ratio(turning_axis.z, size),
                                          ratio(turning_cosine, size)),
                               conjugate(at));
  dvec3 spin = double(2) * dvec3(turning.x, turning.y, turning.z);
  STORE3(p.centre, 0u, centre)
  STORE3(p.velocity, 0u, velocity)
  STORE3(p.spin, 0u, spin)
  p.quaternion[0] = at.x;
  p.quaternion[1] = at.y;
  p.quaternion[2] = at.z;
  p.quaternion[3] = at.w;
  return p;
}

// Turns the place of a key into that of the body's centre, and adds the drift.
FN PathPoint point_of_body(IN(Path) path, PathPoint p, double time) {
  dvec3 arm = rotate_by(quaternion_of(p), LOAD3(path.arm, 0u)), drift = LOAD3(path.drift, 0u);
  dvec3 centre = LOAD3(p.centre, 0u) + time * drift + arm;
  dvec3 velocity = LOAD3(p.velocity, 0u) + drift + cross(LOAD3(p.spin, 0u), arm);
  STORE3(p.centre, 0u, centre)
  STORE3(p.velocity, 0u, velocity)
  return p;
}

SHARED_END
#endif
