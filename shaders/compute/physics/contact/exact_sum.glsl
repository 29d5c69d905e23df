// Sums of whole numbers in 64 bits, from many threads. Such sums have no order, so they come out the same on every device.
#ifndef EXACT_SUM_GLSL
#define EXACT_SUM_GLSL
#include "../language.glsl"
SHARED_BEGIN
#ifdef __cplusplus
using std::floor;
#endif

// Two's complement in two halves. Expects a whole number below 2^63.
FN uvec2 halves_of(double whole) {
  double high = floor(whole * (double(1) / double(4294967296.0)));
  double low = whole - high * double(4294967296.0);
  return uvec2(uint(low), uint(int(high)));
}

// Exact up to 2^53, rounded beyond.
FN double whole_of(uvec2 halves) { return double(int(halves.y)) * double(4294967296.0) + double(halves.x); }

// Adds a whole number to a sum that other threads add to.
#define ADD_EXACTLY(sum, whole)                                       \
  {                                                                   \
    uvec2 halves = halves_of(whole);                                  \
    uint before = atomicAdd((sum).x, halves.x);                       \
    uint carried = halves.y + (before + halves.x < before ? 1u : 0u); \
    if (carried != 0u) atomicAdd((sum).y, carried);                   \
  }

SHARED_END
#endif
