// Axis-aligned boxes. Minimum and maximum are exact, so every device computes the same boxes, in any order.
#ifndef BOX_GLSL
#define BOX_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct Box { vec3 lower; vec3 upper; };

FN Box empty_box() {
  Box box;
  box.lower = vec3(3.0e38f);
  box.upper = vec3(-3.0e38f);
  return box;
}

// Boxes are closed: touching ones overlap.
FN bool overlaps(Box a, Box b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

// A box whose corners have a fourth number, the same in all boxes that are compared. A processor handles such a corner in one instruction.
struct PaddedBox { vec4 lower; vec4 upper; };

FN PaddedBox joined(IN(PaddedBox) a, IN(PaddedBox) b) {
  PaddedBox both;
  both.lower = min(a.lower, b.lower);
  both.upper = max(a.upper, b.upper);
  return both;
}

// One comparison, because processors can't foresee the results of six. On a processor boxes with NaN overlap all
// others, but where boxes are joined it may be lost.
FN bool overlaps(IN(PaddedBox) a, IN(PaddedBox) b) {
  return !any_above(a.lower, b.upper, b.lower, a.upper);
}

// Bits that order as the floats do, for atomicMin and atomicMax.
FN uint ordered_bits(float value) {
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

FN float from_ordered_bits(uint bits) {
  return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

// A box as bits that order as floats do.
struct BoxBits { uint lower[3]; uint upper[3]; };

FN Box box_of_bits(IN(BoxBits) bits) {
  Box box;
  box.lower = vec3(from_ordered_bits(bits.lower[0]), from_ordered_bits(bits.lower[1]), from_ordered_bits(bits.lower[2]));
  box.upper = vec3(from_ordered_bits(bits.upper[0]), from_ordered_bits(bits.upper[1]), from_ordered_bits(bits.upper[2]));
  return box;
}

SHARED_END
#endif
