// Sums of whole numbers in 64 bits, from many threads. Such sums have no order, so threads do not matter.
#ifndef EXACT_SUM_GLSL
#define EXACT_SUM_GLSL
#include "../language.glsl"
SHARED_BEGIN

// The nearest whole number. Expects a number below 2^51: this one, added and subtracted, leaves no digits behind the point.
FN double nearest_whole(double number) {
  const double most = double(6755399441055744.0);
  EXACT double sum = number + most;
  EXACT double whole = sum - most;
  return whole;
}

// A whole number is two's complement in two halves, the low one first.
FN uvec2 sum_of(uvec2 a, uvec2 b) {
  uint low = a.x + b.x;
  return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}

FN uvec2 negative_of(uvec2 a) { return sum_of(uvec2(~a.x, ~a.y), uvec2(1u, 0u)); }

// A double holds it exactly up to 2^53, and rounds it beyond.
#ifdef __cplusplus
FN double whole_of(IN(uvec2) halves) { return static_cast<double>(std::bit_cast<std::int64_t>(halves)); }
FN uvec2 halves_of(double whole) { return std::bit_cast<uvec2>(static_cast<std::int64_t>(whole)); }

FN void add_halves(uvec2& sum, uvec2 halves, bool works_alone) {
  using Sum [[gnu::may_alias]] = std::uint64_t;  // which wraps
  const auto whole = std::bit_cast<std::uint64_t>(halves);
  Sum& shared = reinterpret_cast<Sum&>(sum);
  if (works_alone)
    shared += whole;
  else
    std::atomic_ref(shared).fetch_add(whole, std::memory_order_relaxed);
}
using WholeSum = uvec2;
FN uvec2 halves_of_sum(IN(WholeSum) sum) { return sum; }
#define CLEAR_SUM(sum)       \
  ATOMIC_STORE((sum).x, 0u); \
  ATOMIC_STORE((sum).y, 0u);
// A kernel knows whether its thread works alone: device/cpu/kernel_prelude.inc.
#define ADD_LOW_HALF(sum, halves) (add_halves(sum, halves, works_alone), 0u)
#define ADD_HIGH_HALF(sum, halves, before) static_cast<void>(before);
#else
double whole_of(uvec2 halves) { return double(int(halves.y)) * double(4294967296.0) + double(halves.x); }

uvec2 halves_of(double whole) {
  double high = floor(whole * (double(1) / double(4294967296.0)));
  return uvec2(uint(whole - high * double(4294967296.0)), uint(int(high)));
}

// How a kernel may view an array of sums. Some GPUs add 64 bits at once.
#ifdef ADDS_64_BITS
#define WholeSum uint64_t
uvec2 halves_of_sum(uint64_t sum) { return unpackUint2x32(sum); }
#define CLEAR_SUM(sum) (sum) = uint64_t(0);
#else
#define WholeSum uvec2
uvec2 halves_of_sum(uvec2 sum) { return sum; }
#define CLEAR_SUM(sum) (sum) = uvec2(0);
#endif
#define ADD_LOW_HALF(sum, halves) atomicAdd((sum).x, (halves).x)
#define ADD_HIGH_HALF(sum, halves, before) atomicAdd((sum).y, (halves).y + ((before) + (halves).x < (before) ? 1u : 0u));
#endif

// Adds a whole number to a sum that other threads add to. An addition whose result is used takes 0.7 us on an H200. Who adds several
// numbers therefore adds all low halves first, which returns what was there, and then the high halves.
#define ADD_EXACTLY(sum, whole)                       \
  {                                                   \
    uvec2 halves_of_it = halves_of(whole);            \
    uint before_it = ADD_LOW_HALF(sum, halves_of_it); \
    ADD_HIGH_HALF(sum, halves_of_it, before_it)       \
  }

// The same where all threads that come here together add to one sum. On a GPU one of them does it for all of its subgroup. On the CPU each
// adds once for its items of a loop, so no other item of a round or dispatch may read the sum.
#ifdef HAS_SUBGROUPS
uvec2 sum_of_subgroup(uvec2 halves) {
  uint first = subgroupAdd(halves.x & 0xffffu), second = subgroupAdd(halves.x >> 16u) + (first >> 16u);
  return uvec2((first & 0xffffu) | second << 16u, subgroupAdd(halves.y) + (second >> 16u));
}
#define ADD_EXACTLY_TOGETHER(sum, whole)                     \
  {                                                          \
    uvec2 halves_of_all = sum_of_subgroup(halves_of(whole)); \
    if (subgroupElect() && halves_of_all != uvec2(0)) {      \
      uint before_all = ADD_LOW_HALF(sum, halves_of_all);    \
      ADD_HIGH_HALF(sum, halves_of_all, before_all)          \
    }                                                        \
  }
#elif defined(__cplusplus)
#define ADD_EXACTLY_TOGETHER(sum, whole) exact_tallies.add(sum, halves_of(whole));
#else
#define ADD_EXACTLY_TOGETHER(sum, whole)                     \
  {                                                          \
    double wanted = (whole);                                 \
    if (wanted != double(0)) ADD_EXACTLY(sum, wanted)        \
  }
#endif

SHARED_END

// The same in the precision of forces, because many GPUs have few units for doubles.
REAL_BEGIN
#ifdef __cplusplus
using std::floor;
#endif
// The low half counts with a sign, so that small numbers keep their digits.
FN real real_by_halves(IN(uvec2) halves) {
  int low = int(halves.x);
  return real(int(halves.y) + (low < 0 ? 1 : 0)) * real(4294967296.0) + real(low);
}

// Of a whole number near this one. Expects one below 2^62.
FN uvec2 halves_by_halves(real number) {
  real size = abs(number), high = floor(size * (real(1) / real(4294967296.0)));
  uvec2 halves = uvec2(uint((size - high * real(4294967296.0)) + real(0.5)), uint(high));
  return number < real(0) ? negative_of(halves) : halves;
}

// Processors convert all 64 bits at once.
#ifdef __cplusplus
FN real real_of(IN(uvec2) halves) { return static_cast<real>(std::bit_cast<std::int64_t>(halves)); }
FN uvec2 halves_of_real(real number) {
  return std::bit_cast<uvec2>(static_cast<std::int64_t>(number + std::copysign(real(0.5), number)));
}
#else
real real_of(uvec2 halves) { return real_by_halves(halves); }
uvec2 halves_of_real(real number) { return halves_by_halves(number); }
#endif
REAL_END
#endif
