// Rotations as unit quaternions in fp64. Each operation rounds by itself, so that all kernels turn frames by the same bits.
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
  EXACT double x = a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y;
  EXACT double y = a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x;
  EXACT double z = a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w;
  EXACT double w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z;
  return quaternion(x, y, z, w);
}

FN Quaternion conjugate(Quaternion q) { return quaternion(-q.x, -q.y, -q.z, q.w); }

FN Quaternion normalized(Quaternion q) {
  EXACT double squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  EXACT double size = sqrt(squared);
  EXACT double x = q.x / size;
  EXACT double y = q.y / size;
  EXACT double z = q.z / size;
  EXACT double w = q.w / size;
  return quaternion(x, y, z, w);
}

FN dvec3 rotate_by(Quaternion q, dvec3 p) {
  dvec3 axis = dvec3(q.x, q.y, q.z);
  EXACT dvec3 t = double(2) * ordered_cross(axis, p);
  EXACT dvec3 turned = p + q.w * t + ordered_cross(axis, t);
  return turned;
}

SHARED_END
#endif
