// Which force kernels serve which bodies. What a GPU with many multiprocessors would have is chosen on any machine.
#include "state/force_groups.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "device/gpu/lanes.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t multiprocessors = 132;  // of an H200

std::vector<ForceVariant> variants_of_h200() { return gpu::force_variants(false, multiprocessors); }

// `count` bodies of so many vertices each, of which the first ones move.
std::vector<BodyToShare> bodies_of(std::uint32_t vertices, std::size_t count, std::size_t moving) {
  std::vector<BodyToShare> bodies(count, {vertices, true, false});
  for (std::size_t b = 0; b < moving; ++b) bodies[b].moves = true;
  return bodies;
}

std::vector<BodyToShare> operator+(std::vector<BodyToShare> some, const std::vector<BodyToShare>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

struct Choice {
  std::vector<ForceVariant> variants;
  std::vector<std::size_t> of_bodies;
  std::vector<ForceGroup> groups;

  [[nodiscard]] std::uint32_t lanes(std::size_t body) const { return variants[of_bodies[body]].lanes; }
};

Choice choice_for(std::span<const BodyToShare> bodies) {
  Choice choice{variants_of_h200(), {}, {}};
  const ForceAbilities device{choice.variants, multiprocessors};
  choice.of_bodies = best_force_variants(device, bodies);
  choice.groups = force_groups(device, bodies, choice.of_bodies);
  return choice;
}

TEST_CASE("many bodies at rest do not change how threads share the springs of one that moves") {
  for (const std::uint32_t vertices : {42u, 64u, 162u, 256u, 642u, 2562u}) {
    const Choice alone = choice_for(bodies_of(vertices, 1, 1));
    for (const std::size_t count : {67u, 100u, 400u, 10'000u}) {
      CAPTURE(vertices, count);
      const Choice among_many = choice_for(bodies_of(vertices, count, 1));
      CHECK(among_many.variants[among_many.of_bodies[0]].lanes == alone.lanes(0));
      REQUIRE(among_many.groups.size() == 1);
      CHECK(among_many.groups[0].quiet_steps);
    }
  }
}

TEST_CASE("a body of several shares has many lanes in quiet steps where a few others rest") {
  for (const std::size_t count : {2u, 10u, 20u, 27u, 30u, 44u, 45u}) {
    CAPTURE(count);
    const Choice choice = choice_for(bodies_of(162, count, 1));
    CHECK(choice.lanes(0) >= 32);
    CHECK(choice.groups[0].quiet_steps);
  }
}

TEST_CASE("small bodies are whole while others would have to wait for each other") {
  for (std::size_t count = 34; count <= 40; ++count) {
    const Choice choice = choice_for(bodies_of(64, count, count));
    CHECK(choice.groups[0].has_whole_bodies);
    CHECK(choice.groups[0].all_stages);
  }
}

// docs/benchmarks/2026-11-27-quiet-steps.md has the times.
TEST_CASE("bodies of 162 vertices have what was the fastest for so many") {
  const Choice few = choice_for(bodies_of(162, 20, 20));
  CHECK(few.lanes(0) == 32);
  CHECK(few.groups[0].quiet_steps);
  for (const std::size_t count : {50u, 100u}) {
    const Choice more = choice_for(bodies_of(162, count, count));
    CHECK(more.lanes(0) == 1);
    CHECK(more.groups[0].quiet_steps);
  }
  const Choice mixed = choice_for(bodies_of(42, 500, 500) + bodies_of(162, 500, 500));
  CHECK(mixed.groups.size() == 1);
  CHECK(mixed.lanes(0) == 1);
  const Choice large = choice_for(bodies_of(42, 500, 500) + bodies_of(642, 100, 100));
  CHECK(large.groups.size() == 2);
}

TEST_CASE("every soft body is served, and none waits for shares that may not run beside its own") {
  std::mt19937 random(5);
  const auto at_most = [&](std::uint32_t most) { return 1 + static_cast<std::uint32_t>(random() % most); };
  for (int scene = 0; scene < 300; ++scene) {
    std::vector<BodyToShare> bodies;
    const std::uint32_t count = at_most(scene % 3 == 0 ? 400 : 20), largest = at_most(scene % 2 == 0 ? 300 : 20'000);
    for (std::uint32_t b = 0; b < count; ++b) bodies.push_back({at_most(largest), random() % 8 != 0, false});
    for (BodyToShare& body : bodies) body.moves = body.is_soft && random() % 2 == 0;
    const Choice choice = choice_for(bodies);
    std::uint32_t shares = 0;
    for (const ForceGroup& group : choice.groups) {
      CHECK(group.first_share == shares);
      shares += group.share_count;
      if (group.has_whole_bodies) continue;
      CHECK((!group.all_stages || (choice.groups.size() == 1 && group.share_count <= multiprocessors)));
    }
    std::uint32_t expected = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].is_soft) continue;
      const std::uint32_t share_size = choice.variants[choice.of_bodies[b]].share_size;
      expected += (bodies[b].vertex_count + share_size - 1) / share_size;
      CHECK(std::ranges::count(choice.groups, choice.of_bodies[b], &ForceGroup::variant) == 1);
    }
    CHECK(shares == expected);
  }
}

TEST_CASE("software that runs shaders has one way for all bodies, and waits for no other group") {
  const std::vector<ForceVariant> variants = gpu::force_variants(true, 0);
  for (const std::uint32_t vertices : {1u, 42u, 162u, 642u, 100'000u})
    for (const std::size_t count : {1u, 20u}) {
      const std::vector<BodyToShare> bodies = bodies_of(vertices, count, count);
      const std::vector<std::size_t> chosen = best_force_variants({variants, 0}, bodies);
      CHECK(chosen == std::vector<std::size_t>(count, 0));
      const std::vector<ForceGroup> groups = force_groups({variants, 0}, bodies, chosen);
      CHECK(groups[0].all_stages == groups[0].has_whole_bodies);
    }
}

}  // namespace
}  // namespace pliant
