// This dialect lets a file be GLSL 4.50 and C++20 at once. `real` is the precision of the forces: float in shaders, float or double
// on the CPU (REAL_BITS). Everything else says float or double itself.
#ifndef LANGUAGE_GLSL
#define LANGUAGE_GLSL
#ifdef __cplusplus
  #include <glm/vec2.hpp>
  #include <glm/vec3.hpp>
  #include <glm/vec4.hpp>
  #include <glm/common.hpp>
  #include <glm/geometric.hpp>
  #include <atomic>
  #include <bit>
  #include <cstdint>
  #include <cmath>
  #include <type_traits>
  #ifdef __SSE__
    #include <xmmintrin.h>
  #endif
  #define SHARED_BEGIN namespace pliant::physics {
  #define SHARED_END }
  namespace pliant::physics {}
  #if defined(REAL_BITS) && REAL_BITS == 64
    #define REAL_NAMESPACE pliant::physics64
    namespace pliant::physics64 { using namespace pliant::physics; using real = double; inline constexpr real real_epsilon = 0x1p-52; }
  #else
    #define REAL_NAMESPACE pliant::physics32
    namespace pliant::physics32 { using namespace pliant::physics; using real = float; inline constexpr real real_epsilon = 0x1p-23f; }
  #endif
  #define REAL_BEGIN namespace REAL_NAMESPACE { using real3 = glm::vec<3, real>; using real4 = glm::vec<4, real>;
  #define REAL_END }
  // Each file has its own, at its own level of optimization: a linker could take a slow one for all. It still takes one of an
  // inline function in a header that calls these.
  #define FN static inline
  #define IN(T) const T&
  #define OUT(T) T&
  #define INOUT(T) T&
  #define IN_ARRAY(T, name, n) const T (&name)[n]
  #define EXACT
  #define FUSED(a, b, c) ((a) * (b) + (c))
  // On the CPU a kernel's declarations are members of its struct. On a GPU the loader writes them out (kernel_source.hpp).
  #define READ(name) const array::name::element* const name = arguments.read<array::name::element>(#name);
  #define WRITE(name) array::name::element* const name = arguments.write<array::name::element>(#name);
  #define SHARED_WRITE(name) WRITE(name)
  #define READ_AS(array_name, T, name) const T* const name = arguments.read<T>(#array_name, #T);
  #define WRITE_AS(array_name, T, name) T* const name = arguments.write<T>(#array_name, #T);
  #define SHARED_WRITE_AS(array_name, T, name) WRITE_AS(array_name, T, name)
  #define CONSTANTS(name, count) const array::name::element* const name = arguments.constants<array::name::element>(#name);
  #define PARAMETER(T, name) const T name = arguments.parameter<T>(#name);
  #define PRIVATE(T, name) T name{};
  // A group kernel (groups.comp) serves an item by THREADS threads, of which each is a THREAD. They MEET, and have NEAR memory in common.
  // On the CPU that is one thread. PRIVATE and NEAR are members there, which all items that a thread takes of a loop have in common. So an
  // item sets them before it reads them.
  #define THREAD 0u
  #define THREADS 1u
  #define MEET
  #define NEAR(T, name, n) T name[n]{};
  #define NEAR_ADD(before, target, value) const uint before = target; target += (value);
  #define ATOMIC_STORE(target, value) store_unless_there(target, value)
  #define ATOMIC_LOAD(target) std::atomic_ref(target).load(std::memory_order_relaxed)
  #define TALLY_UP(tally, count) tallies.add(tally, count);
  #define APPEND(list, count, capacity, value) appended.add(list, count, capacity, value);
  #define APPEND_EACH(k, set, list, count, capacity, value)                       \
    {                                                                             \
      for (uint bits_left = (set); bits_left != 0u; bits_left &= bits_left - 1u) { \
        const uint k = uint(findLSB(bits_left));                                  \
        appended.add(list, count, capacity, value);                               \
      }                                                                           \
    }
#else
  #define real float
  #define real_epsilon 1.1920929e-7  // 2^-23
  #define real3 vec3
  #define real4 vec4
  #define SHARED_BEGIN
  #define SHARED_END
  #define REAL_BEGIN
  #define REAL_END
  #define FN
  #define IN(T) in T
  #define OUT(T) out T
  #define INOUT(T) inout T
  #define IN_ARRAY(T, name, n) in T name[n]
  #define PRIVATE(T, name) T name;      // each thread has its own
  #ifdef DESCENDS  // turns.glsl says why
    #define THREAD (gl_WorkGroupSize.x - 1u - gl_LocalInvocationID.x)
  #else
    #define THREAD gl_LocalInvocationID.x
  #endif
  #define THREADS gl_WorkGroupSize.x
  #define MEET { groupMemoryBarrier(); barrier(); }
  #define NEAR(T, name, n) shared T name[n];
  #define NEAR_ADD(before, target, value) uint before = atomicAdd(target, value);
  #define EXACT precise                 // every operation rounds by itself, in the order written
  #define FUSED(a, b, c) fma(a, b, c)   // a b + c rounded once, where the hardware can
  #define ATOMIC_STORE(target, value) (target) = (value)  // in a round nothing else stores another value there
  #define ATOMIC_LOAD(target) (target)
#endif

// A minimum and a maximum of many threads. Most of them would change nothing, and leave the atomic out. An older value than the latest
// only makes them do it after all.
#define LOWER_TO(target, value) if ((value) < ATOMIC_LOAD(target)) atomicMin(target, value);
#define RAISE_TO(target, value) if ((value) > ATOMIC_LOAD(target)) atomicMax(target, value);

// Additions of many threads to one number come one after the other: each takes some 0.5 ns on an H100, and 50 ns between 16 threads of a
// Xeon. So on the CPU a thread does what follows at the end of its items of a loop.
// - TALLY_UP counts what nothing in this dispatch reads. On a GPU one thread adds for its subgroup.
// - APPEND adds a value to a list, and counts values beyond its capacity, too. Nothing in this dispatch may read the values, or rely on the
//   count: on the CPU it lacks up to 64 for each thread. On a GPU each thread takes places by itself: threads come for them from loops of
//   their own, and GLSL doesn't say which of a subgroup are together there.
// - APPEND_EACH does the same with a value for each k that is set in 32 bits.
#ifndef __cplusplus
  #define APPEND(list, count, capacity, value)               \
    {                                                        \
      uint list_place = atomicAdd(count, 1u);                \
      if (list_place < (capacity)) list[list_place] = value; \
    }
  #define APPEND_EACH(k, set, list, count, capacity, value)         \
    {                                                               \
      uint bits_left = (set);                                       \
      uint list_place = atomicAdd(count, uint(bitCount(bits_left))); \
      for (; bits_left != 0u; bits_left &= bits_left - 1u) {        \
        uint k = uint(findLSB(bits_left));                          \
        if (list_place < (capacity)) list[list_place] = value;      \
        ++list_place;                                               \
      }                                                             \
    }
  #ifdef HAS_SUBGROUPS
    #define TALLY_UP(tally, count)                                         \
      {                                                                    \
        uint together = subgroupAdd(count);                                \
        if (subgroupElect() && together != 0u) atomicAdd(tally, together); \
      }
  #else
    #define TALLY_UP(tally, count) if ((count) != 0u) atomicAdd(tally, count);
  #endif
#endif

// Flat arrays of doubles hold three numbers a vector, because std430 and C++ disagree on arrays of dvec3. In a local struct their places are
// constants, never a loop's number: NVIDIA's driver 580 keeps such a struct in memory then, and stores its doubles as floats there.
#define LOAD3(array, first) dvec3((array)[(first)], (array)[(first) + 1u], (array)[(first) + 2u])
#define STORE3(array, first, value)          \
  {                                          \
    (array)[(first)] = (value).x;            \
    (array)[(first) + 1u] = (value).y;       \
    (array)[(first) + 2u] = (value).z;       \
  }

SHARED_BEGIN
#ifdef __cplusplus
using glm::ivec3, glm::uint, glm::uvec2, glm::uvec3, glm::uvec4, glm::vec2, glm::vec3, glm::vec4, glm::dvec2, glm::dvec3;
using glm::abs, glm::cross, glm::dot, glm::inversesqrt, glm::length, glm::max, glm::min;
using std::abs, std::sqrt;
// Those of glm take the numbers of a vector one by one, and branch on signs. A header that names one in the namespace of a precision hides
// those that follow here.
FN vec3 abs(IN(vec3) v) { return vec3(std::abs(v.x), std::abs(v.y), std::abs(v.z)); }
FN dvec3 abs(IN(dvec3) v) { return dvec3(std::abs(v.x), std::abs(v.y), std::abs(v.z)); }
#ifdef __SSE__
FN __m128 lanes(IN(vec4) v) { return _mm_loadu_ps(&v.x); }
FN vec4 of_lanes(__m128 lanes) {
  vec4 v;
  _mm_storeu_ps(&v.x, lanes);
  return v;
}
FN vec4 min(IN(vec4) a, IN(vec4) b) { return of_lanes(_mm_min_ps(lanes(a), lanes(b))); }
FN vec4 max(IN(vec4) a, IN(vec4) b) { return of_lanes(_mm_max_ps(lanes(a), lanes(b))); }
FN vec4 operator+(IN(vec4) a, IN(vec4) b) { return of_lanes(_mm_add_ps(lanes(a), lanes(b))); }
FN vec4 operator-(IN(vec4) a, IN(vec4) b) { return of_lanes(_mm_sub_ps(lanes(a), lanes(b))); }
FN vec4 operator*(IN(vec4) a, IN(vec4) b) { return of_lanes(_mm_mul_ps(lanes(a), lanes(b))); }
FN vec4 operator*(IN(vec4) a, float b) { return of_lanes(_mm_mul_ps(lanes(a), _mm_set1_ps(b))); }
FN vec4 abs(IN(vec4) v) { return of_lanes(_mm_andnot_ps(_mm_set1_ps(-0.0f), lanes(v))); }
// Whether a component of a is above that of b, or one of c above that of d.
FN bool any_above(IN(vec4) a, IN(vec4) b, IN(vec4) c, IN(vec4) d) {
  return _mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(lanes(a), lanes(b)), _mm_cmpgt_ps(lanes(c), lanes(d)))) != 0;
}
// A bit for each component: whether it is above that of b.
FN uint bits_above(IN(vec4) a, IN(vec4) b) { return uint(_mm_movemask_ps(_mm_cmpgt_ps(lanes(a), lanes(b)))); }
FN __m128 halves_swapped(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(1, 0, 3, 2)); }
FN __m128 pairs_swapped(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(2, 3, 0, 1)); }
// The smallest and the largest component.
FN float least_of(IN(vec4) v) {
  const __m128 two = _mm_min_ps(lanes(v), halves_swapped(lanes(v)));
  return _mm_cvtss_f32(_mm_min_ps(two, pairs_swapped(two)));
}
FN float largest_of(IN(vec4) v) {
  const __m128 two = _mm_max_ps(lanes(v), halves_swapped(lanes(v)));
  return _mm_cvtss_f32(_mm_max_ps(two, pairs_swapped(two)));
}
#endif
// Of threads that store the same value only the first makes the others' caches fetch it anew. In a round nothing else may store another
// value there, atomically or not: that store could be lost, or this one.
template <class T>
FN void store_unless_there(T& target, std::type_identity_t<T> value) {
  const std::atomic_ref shared(target);
  if (shared.load(std::memory_order_relaxed) != value) shared.store(value, std::memory_order_relaxed);
}
// GLSL's atomic functions, for threads of the CPU. Each returns the value from before.
FN uint atomicAdd(uint& target, uint value) { return std::atomic_ref(target).fetch_add(value, std::memory_order_acq_rel); }
FN uint atomicExchange(uint& target, uint value) { return std::atomic_ref(target).exchange(value, std::memory_order_relaxed); }
FN uint atomicMin(uint& target, uint value) {
  std::atomic_ref shared(target);
  uint before = shared.load(std::memory_order_relaxed);
  while (value < before && !shared.compare_exchange_weak(before, value, std::memory_order_relaxed)) {
  }
  return before;
}
FN uint atomicMax(uint& target, uint value) {
  std::atomic_ref shared(target);
  uint before = shared.load(std::memory_order_relaxed);
  while (value > before && !shared.compare_exchange_weak(before, value, std::memory_order_relaxed)) {
  }
  return before;
}
FN uint atomicCompSwap(uint& target, uint expected, uint value) {
  std::atomic_ref(target).compare_exchange_strong(expected, value, std::memory_order_acq_rel);
  return expected;
}
FN uint atomicOr(uint& target, uint bits) { return std::atomic_ref(target).fetch_or(bits, std::memory_order_acq_rel); }
FN int bitCount(uint bits) { return std::popcount(bits); }
FN int findLSB(uint bits) { return bits == 0 ? -1 : std::countr_zero(bits); }
FN uint floatBitsToUint(float value) { return std::bit_cast<uint>(value); }
FN float uintBitsToFloat(uint bits) { return std::bit_cast<float>(bits); }
#endif
#ifndef __SSE__
FN bool any_above(IN(vec4) a, IN(vec4) b, IN(vec4) c, IN(vec4) d) {
  return a.x > b.x || a.y > b.y || a.z > b.z || a.w > b.w || c.x > d.x || c.y > d.y || c.z > d.z || c.w > d.w;
}
FN uint bits_above(IN(vec4) a, IN(vec4) b) {
  return (a.x > b.x ? 1u : 0u) | (a.y > b.y ? 2u : 0u) | (a.z > b.z ? 4u : 0u) | (a.w > b.w ? 8u : 0u);
}
FN float least_of(IN(vec4) v) { return min(min(v.x, v.y), min(v.z, v.w)); }
FN float largest_of(IN(vec4) v) { return max(max(v.x, v.y), max(v.z, v.w)); }
#endif
// The dot and the cross product. Every device rounds them in the order written.
FN float ordered_dot(vec3 a, vec3 b) {
  EXACT float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}
FN vec3 ordered_cross(IN(vec3) a, IN(vec3) b) {
  EXACT vec3 product = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return product;
}
FN double ordered_dot(IN(dvec3) a, IN(dvec3) b) {
  EXACT double sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  return sum;
}
FN dvec3 ordered_cross(IN(dvec3) a, IN(dvec3) b) {
  EXACT dvec3 product = dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return product;
}
SHARED_END
#endif
