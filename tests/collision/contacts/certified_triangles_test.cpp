#include "physics/collision/certified_triangles.glsl"

#include <bit>
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <random>

#include "collision/contacts/degenerate_cases.hpp"
#include "collision/contacts/exact_triangles.hpp"
#include "device/cpu/waiting_pairs.hpp"

namespace pliant::testing {
namespace {

/// The latest pairs, so that each comes beside others and in another lane than the one before.
struct Lanes {
  cpu::TriangleLanes pairs{};
  unsigned next = 0;

  unsigned add(const Triangle& a, const Triangle& b) {
    const unsigned lane = next++ % cpu::most_lanes;
    cpu::set_lane(pairs, lane, [&](unsigned triangle, unsigned k) { return glm::vec4((triangle == 0 ? a : b)[k], 1); });
    return lane;
  }
};

/// Also checks that vectors give the same answer, or none. This is not inlined, so that the arithmetic sees the rounding
/// direction in force.
[[gnu::noinline]] bool may_touch(const Triangle& a, const Triangle& b) {
  static Lanes lanes;
  const glm::vec3 p[3] = {a[0], a[1], a[2]}, q[3] = {b[0], b[1], b[2]};
  const bool answer = physics::triangles_may_touch(p, q);
  const unsigned lane = lanes.add(a, b);
  for (const cpu::Isa isa : cpu::available_isas()) {
    const cpu::LaneAnswers answers = cpu::lane_test(isa)(lanes.pairs, lane + 1);
    const bool touching = (answers.touching >> lane & 1u) != 0, unknown = (answers.unknown >> lane & 1u) != 0;
    if (touching != (answer && !unknown)) FAIL("not so in vectors, lane " << lane << ", " << cpu::name_of(isa));
  }
  return answer;
}

/// A gap, relative to the size of the pair, at which triangles have to be told apart.
constexpr double certain_gap = 1e-5;

class Random {
 public:
  std::int64_t operator()(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine_);
  }
  Lattice3 point(std::int64_t range) { return {(*this)(-range, range), (*this)(-range, range), (*this)(-range, range)}; }
  LatticeTriangle triangle(std::int64_t range) { return {point(range), point(range), point(range)}; }

 private:
  std::mt19937_64 engine_{20240229};
};

struct LatticePair {
  LatticeTriangle a, b;
};

/// Few lattice points, so that most pairs touch in a corner, along an edge, in a plane, or have no area.
LatticePair crowded(Random& random) { return {random.triangle(3), random.triangle(3)}; }

/// b has a corner, or the middle of an edge, within a few steps of a point of a. Gaps go from 0 to 1e-5 of the size.
LatticePair nearly_touching(Random& random) {
  constexpr std::int64_t range = 1 << 19;
  LatticePair pair{random.triangle(range), random.triangle(range)};
  const std::int64_t s = random(0, 16), t = random(0, 16 - s);
  const Lattice3 place = pair.a[0] + (s * (pair.a[1] - pair.a[0]) + t * (pair.a[2] - pair.a[0])) / std::int64_t(16);
  pair.b[0] = place + random.point(random(0, 8));
  if (random(0, 1) == 1) {
    const Lattice3 arm = random.point(range / 4);
    pair.b[1] = pair.b[0] + arm;
    pair.b[0] -= arm;
  }
  return pair;
}

/// Like nearly_touching, with one edge of a only a few steps long.
LatticePair needles(Random& random) {
  LatticePair pair = nearly_touching(random);
  const auto corner = static_cast<std::size_t>(random(0, 2));
  pair.a[corner] = pair.a[(corner + 1) % 3] + random.point(random(0, 4));
  return pair;
}

/// All six corners in one slanted plane.
LatticePair coplanar(Random& random) {
  const Lattice3 u = random.point(200), v = random.point(200);
  const auto in_plane = [&] { return random(-200, 200) * u + random(-200, 200) * v; };
  return {{in_plane(), in_plane(), in_plane()}, {in_plane(), in_plane(), in_plane()}};
}

/// Scales by a power of two and shifts. Neither rounds, as long as offset + scale * point has 24 bits.
Triangle place(const LatticeTriangle& t, int exponent, float offset) {
  Triangle placed;
  for (std::size_t k = 0; k < 3; ++k) placed[k] = glm::vec3(glm::dvec3(t[k]) * std::ldexp(1.0, exponent)) + glm::vec3(offset);
  return placed;
}

struct Errors {
  int missed = 0;   // touching pairs reported apart
  int phantom = 0;  // pairs reported touching at a gap that must be certain
  int touching = 0, apart = 0;
};

Errors check(LatticePair (*make)(Random&), int count, int exponent = 0, float offset = 0.0f) {
  Random random;
  Errors errors;
  for (int i = 0; i < count; ++i) {
    const LatticePair pair = make(random);
    const Triangle a = place(pair.a, exponent, offset), b = place(pair.b, exponent, offset);
    const bool touch = exactly_touch(pair.a, pair.b), claim = may_touch(a, b);
    ++(touch ? errors.touching : errors.apart);
    errors.missed += touch && !claim;
    errors.phantom += !touch && claim && relative_gap(a, b) > certain_gap;
  }
  return errors;
}

void require_correct(const Errors& errors) {
  CHECK(errors.missed == 0);
  CHECK(errors.phantom == 0);
  CHECK(errors.touching > 0);
  CHECK(errors.apart > 0);
}

}  // namespace

TEST_CASE("triangles that touch are never certified apart, in any order of corners and arguments") {
  for (const TrianglePair& pair : triangle_pairs()) {
    if (pair.touch != true) continue;
    INFO(pair.id);
    int missed = 0;
    for_every_order(pair.a, pair.b, [&](const Triangle& a, const Triangle& b) { missed += !may_touch(a, b); });
    CHECK(missed == 0);
  }
}

TEST_CASE("triangles a hundred-thousandth of their size apart are certified apart, in any order of corners and arguments") {
  int cases = 0;
  for (const TrianglePair& pair : triangle_pairs()) {
    if (pair.touch != false || relative_gap(pair.a, pair.b) <= certain_gap) continue;
    INFO(pair.id);
    int phantom = 0;
    for_every_order(pair.a, pair.b, [&](const Triangle& a, const Triangle& b) { phantom += may_touch(a, b); });
    CHECK(phantom == 0);
    ++cases;
  }
  CHECK(cases > 10);
}

TEST_CASE("a coordinate that is not finite makes triangles touch") {
  const Triangle good{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
  const Triangle far{glm::vec3(7), glm::vec3(8, 7, 7), glm::vec3(7, 8, 7)};
  REQUIRE_FALSE(may_touch(good, far));
  for (const float broken : {std::nanf(""), -std::nanf(""), INFINITY, -INFINITY}) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        Triangle bad = far;
        bad[corner][axis] = broken;
        CHECK(may_touch(good, bad));
        CHECK(may_touch(bad, good));
      }
    }
  }
  for (const TrianglePair& pair : triangle_pairs()) {
    if (pair.touch.has_value()) continue;
    for_every_order(pair.a, pair.b, [&](const Triangle& a, const Triangle& b) { CHECK(may_touch(a, b)); });
  }
}

TEST_CASE("segments and points that have no area are told apart") {
  const Triangle point{glm::vec3(1), glm::vec3(1), glm::vec3(1)};
  const Triangle other_point{glm::vec3(1, 2, 3), glm::vec3(1, 2, 3), glm::vec3(1, 2, 3)};
  const Triangle segment{glm::vec3(0, 3, 1), glm::vec3(2, 7, 3), glm::vec3(1, 5, 2)};
  const Triangle beyond{glm::vec3(3, 9, 4), glm::vec3(5, 13, 6), glm::vec3(4, 11, 5)};  // on the same line
  const Triangle beside{glm::vec3(1, 3, 1), glm::vec3(3, 7, 3), glm::vec3(2, 5, 2)};    // on a parallel line
  for (const auto& [a, b] : {std::pair(point, other_point), {point, segment}, {segment, beyond}, {segment, beside}}) {
    for_every_order(a, b, [](const Triangle& p, const Triangle& q) { CHECK_FALSE(may_touch(p, q)); });
  }
}

TEST_CASE("the certified test agrees with exact arithmetic on crowded lattices") { require_correct(check(crowded, 100000)); }
TEST_CASE("the certified test agrees with exact arithmetic near contact") { require_correct(check(nearly_touching, 100000)); }
TEST_CASE("the certified test agrees with exact arithmetic on needles") { require_correct(check(needles, 100000)); }
TEST_CASE("the certified test agrees with exact arithmetic in a common plane") { require_correct(check(coplanar, 100000)); }

TEST_CASE("the certified test holds at every scale and far from the origin") {
  for (const int exponent : {-60, -40, -20, 10, 30, 70}) {  // 1e-18 to 1e21
    INFO("2^" << exponent);
    require_correct(check(nearly_touching, 20000, exponent - 10));
    require_correct(check(crowded, 20000, exponent));
    require_correct(check(coplanar, 20000, exponent));
  }
  require_correct(check(crowded, 50000, -10, 1e4f));
  require_correct(check(crowded, 50000, -3, 1e6f));
}

TEST_CASE("the certified test misses no contact however the processor rounds") {
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    const Errors near = check(nearly_touching, 50000), in_plane = check(coplanar, 50000), small = check(crowded, 50000);
    std::fesetround(FE_TONEAREST);
    INFO("direction " << direction);
    CHECK(near.missed == 0);
    CHECK(in_plane.missed == 0);
    CHECK(small.missed == 0);
  }
}

TEST_CASE("vectors answer for nearly all pairs of triangles in no common plane") {
  for (const cpu::Isa isa : cpu::available_isas()) {
    INFO(cpu::name_of(isa));
    Random random;
    Lanes lanes;
    int pairs = 0, expected = 0, touching = 0, unknown = 0;
    for (; pairs < 16000; pairs += cpu::most_lanes) {
      for (unsigned k = 0; k < cpu::most_lanes; ++k) {
        const Triangle a = place(random.triangle(1 << 19), -19, 0), b = place(random.triangle(1 << 19), -19, 0);
        expected += may_touch(a, b);
        lanes.add(a, b);
      }
      const cpu::LaneAnswers answers = cpu::lane_test(isa)(lanes.pairs, cpu::most_lanes);
      touching += std::popcount(answers.touching);
      unknown += std::popcount(answers.unknown);
    }
    CHECK(unknown < pairs / 1000);
    CHECK(touching <= expected);
    CHECK(touching + unknown >= expected);
    CHECK(expected > pairs / 100);
  }
}

}  // namespace pliant::testing
