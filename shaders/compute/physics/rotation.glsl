// Rotations as unit quaternions in fp64.
#ifndef ROTATION_GLSL
#define ROTATION_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Quaternion { double x; double y; double z; double w; };

FN Quaternion quaternion(double x, double y, double z, double w) {
  Quaternion q;
  q.x = x;
  q.y = y;
  q.z = z;
  q.w = w;
  return q;
}

// The rotation by b, then by a.
FN Quaternion product(Quaternion a, Quaternion b) {
  return quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                    a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
}

FN Quaternion conjugate(Quaternion q) { return quaternion(-q.x, -q.y, -q.z, q.w); }

FN Quaternion normalized(Quaternion q) {
  double size = sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return quaternion(q.x / size, q.y / size, q.z / size, q.w / size);
}

FN dvec3 rotate_by(Quaternion q, dvec3 p) {
  dvec3 axis = dvec3(q.x, q.y, q.z);
  dvec3 t = double(2) * cross(axis, p);
  return p + q.w * t + cross(axis, t);
}

SHARED_END
#endif
