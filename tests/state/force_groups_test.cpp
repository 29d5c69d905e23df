// Which force kernels serve which bodies. What a GPU with many multiprocessors would have is chosen on any machine.
#include "state/force_groups.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "device/gpu/lanes.hpp"

namespace pliant {
namespace {

constexpr gpu::Processors h200{.are_software = false, .multiprocessors = 132};
constexpr gpu::Processors untold{};  // a GPU whose driver does not tell
constexpr gpu::Processors software{.are_software = true, .multiprocessors = 0};

// `count` bodies of so many vertices each, of which the first ones move.
std::vector<ForceBody> bodies_of(std::uint32_t vertices, std::size_t count, std::size_t moving) {
  std::vector<ForceBody> bodies(count, {vertices, true, false});
  for (std::size_t b = 0; b < moving; ++b) bodies[b].moves = true;
  return bodies;
}

std::vector<ForceBody> operator+(std::vector<ForceBody> some, const std::vector<ForceBody>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

struct Choice {
  std::vector<ForceVariant> variants;
  std::vector<std::size_t> of_bodies;
  std::vector<ForceGroup> groups;

  [[nodiscard]] std::uint32_t lanes(std::size_t body) const { return variants[of_bodies[body]].lanes; }
  [[nodiscard]] std::uint32_t shares_of(const ForceBody& body, std::size_t b) const {
    const std::uint32_t size = variants[of_bodies[b]].share_size;
    return body.is_soft ? (body.vertex_count + size - 1) / size : 0;
  }
};

Choice choice_for(std::span<const ForceBody> bodies, const gpu::Processors& gpu = h200) {
  Choice choice{gpu::force_variants(gpu), {}, {}};
  const ForceAbilities device{choice.variants, gpu.multiprocessors};
  choice.of_bodies = choose_force_variants(device, bodies);
  choice.groups = group_shares(device, bodies, choice.of_bodies);
  return choice;
}

TEST_CASE("each variant of the force kernels has a name of its own, and one for quiet steps can run all stages") {
  for (const gpu::Processors& gpu : {h200, software}) {
    const std::vector<ForceVariant> variants = gpu::force_variants(gpu);
    std::set<std::string> names;
    for (const ForceVariant& variant : variants) {
      CHECK(names.insert(variant.name).second);
      CHECK((variant.quiet_groups == 0 || variant.all_stages));
    }
  }
}

TEST_CASE("there is a variant for every body in every scene") {
  for (const gpu::Processors& gpu : {h200, untold, software}) {
    const std::vector<ForceVariant> variants = gpu::force_variants(gpu);
    for (const std::uint32_t vertices : {1u, 2u, 48u, 49u, 64u, 65u, 256u, 257u, 100'000u, ForceVariant::any_number})
      for (const std::uint32_t in_all : {0u, 1u, 2600u, 2601u, 8001u, ForceVariant::any_number})
        CHECK(fastest_force_variant(variants, in_all, vertices) < variants.size());
  }
}

// Those of 49 to 64 vertices are whole among others, as another test says.
TEST_CASE("a body whose sums are given has a variant of its own, and others have the fastest") {
  for (const gpu::Processors& gpu : {h200, software}) {
    std::vector<ForceBody> bodies = bodies_of(42, 3, 3) + bodies_of(40'962, 1, 1);
    bodies.back().has_given_sums = true;
    const std::vector<ForceVariant> variants = gpu::force_variants(gpu);
    const ForceAbilities device{variants, gpu.multiprocessors, gpu::variant_for_given_sums()};
    const std::vector<std::size_t> chosen = choose_force_variants(device, bodies);
    for (std::size_t b = 0; b < 3; ++b) CHECK(chosen[b] == fastest_force_variant(variants, 3 * 42, 42));
    CHECK(chosen[3] == variants.size());
    const std::vector<ForceGroup> groups = group_shares(device, bodies, chosen);
    REQUIRE(groups.size() == 2);
    CHECK(groups[1].share_count == 641);
    CHECK_FALSE((groups[1].all_stages || groups[1].quiet_steps));
    CHECK(groups[1].first_share == groups[0].share_count);
  }
}

TEST_CASE("many bodies at rest do not change which variant serves one that moves, unless it has 49 to 64 vertices") {
  for (const std::uint32_t vertices : {1u, 42u, 48u, 65u, 162u, 256u, 642u, 2562u}) {
    const Choice alone = choice_for(bodies_of(vertices, 1, 1));
    for (const std::size_t count : {67u, 100u, 400u, 10'000u}) {
      CAPTURE(vertices, count);
      const Choice among_many = choice_for(bodies_of(vertices, count, 1));
      CHECK(among_many.of_bodies[0] == alone.of_bodies[0]);
      REQUIRE(among_many.groups.size() == 1);
      CHECK(among_many.groups[0].quiet_steps);
    }
  }
}

TEST_CASE("bodies that cannot move of themselves change nothing") {
  const std::vector<ForceBody> rigid(5, {100'000, false, false});
  for (const std::size_t moving : {0u, 1u, 30u})
    for (const std::uint32_t vertices : {42u, 162u, 642u}) {
      CAPTURE(vertices, moving);
      const std::vector<ForceBody> soft = bodies_of(vertices, 30, moving);
      std::vector<std::size_t> of_soft = choice_for(soft + rigid).of_bodies;
      of_soft.resize(soft.size());
      CHECK(of_soft == choice_for(soft).of_bodies);
    }
}

TEST_CASE("a scene in which nothing moves has the variants of one in which one body does") {
  for (const std::uint32_t vertices : {42u, 162u, 642u})
    CHECK(choice_for(bodies_of(vertices, 20, 0)).of_bodies == choice_for(bodies_of(vertices, 20, 1)).of_bodies);
}

TEST_CASE("a body of several shares has many lanes in quiet steps where others rest") {
  for (const std::size_t count : {2u, 10u, 20u, 27u, 30u, 44u, 45u}) {
    CAPTURE(count);
    const Choice choice = choice_for(bodies_of(162, count, 1));
    CHECK(choice.lanes(0) >= 32);
    CHECK(choice.groups[0].quiet_steps);
  }
}

TEST_CASE("small bodies are whole while others would have to wait for each other") {
  for (const std::size_t moving : {1u, 18u, 40u})
    for (const std::size_t count : {40u, 100u, 1000u}) {
      CAPTURE(count, moving);
      const Choice choice = choice_for(bodies_of(64, count, moving));
      CHECK(choice.groups[0].has_whole_bodies);
      CHECK(choice.groups[0].all_stages);
    }
  for (std::size_t count = 34; count < 40; ++count) CHECK(choice_for(bodies_of(64, count, count)).groups[0].has_whole_bodies);
}

TEST_CASE("a step of one large body is one dispatch, though it has several shares") {
  for (const std::uint32_t vertices : {162u, 642u, 1280u}) {
    CAPTURE(vertices);
    const Choice choice = choice_for(bodies_of(vertices, 1, 1));
    CHECK(choice.lanes(0) == 64);
    CHECK(choice.groups[0].all_stages);
    CHECK_FALSE(choice.groups[0].has_whole_bodies);
  }
}

// With more lanes steps would be quiet, but all shares of both would not run at once.
TEST_CASE("that a step is one dispatch counts for more than that steps are quiet") {
  const Choice choice = choice_for(bodies_of(2562, 2, 1));
  CHECK(choice.groups[0].all_stages);
  CHECK(choice.groups[0].quiet_steps);
}

TEST_CASE("a body that is too large for quiet steps has the same variant whether it moves or rests") {
  for (const std::uint32_t vertices : {6000u, 10'242u, 100'000u}) {
    CAPTURE(vertices);
    const std::size_t of_moving = choice_for(bodies_of(vertices, 1, 1)).of_bodies[0];
    CHECK(choice_for(bodies_of(vertices, 1, 0)).of_bodies[0] == of_moving);
    CHECK(choice_for(bodies_of(42, 1, 1) + bodies_of(vertices, 1, 0)).of_bodies[1] == of_moving);
  }
}

TEST_CASE("where so many move that no step is quiet, those at rest count like those that move") {
  const Choice choice = choice_for(bodies_of(642, 1000, 10));
  CHECK_FALSE(choice.groups[0].quiet_steps);
  CHECK(choice.of_bodies == choice_for(bodies_of(642, 1000, 1000)).of_bodies);
}

// The next two have what was the fastest for so many. docs/benchmarks/2026-11-27-quiet-steps.md has the times.
TEST_CASE("bodies of 42 vertices have eight lanes a vertex, and a thread where there are many") {
  for (const std::size_t count : {1u, 10u, 100u, 1000u, 10'000u}) {
    CAPTURE(count);
    const Choice choice = choice_for(bodies_of(42, count, count));
    CHECK(choice.lanes(0) == (count <= 100 ? 8 : 1));
    CHECK(choice.groups[0].quiet_steps);
  }
}

TEST_CASE("bodies of 162 vertices have 32 lanes a vertex, and a thread where there are many") {
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
  for (const gpu::Processors& gpu : {h200, gpu::Processors{.are_software = false, .multiprocessors = 20}, untold, software})
    for (int scene = 0; scene < 200; ++scene) {
      std::vector<ForceBody> bodies;
      const std::uint32_t count = at_most(scene % 3 == 0 ? 400 : 20), largest = at_most(scene % 2 == 0 ? 300 : 20'000);
      for (std::uint32_t b = 0; b < count; ++b) bodies.push_back({at_most(largest), random() % 8 != 0, false});
      for (ForceBody& body : bodies) body.moves = body.is_soft && random() % 2 == 0;
      const Choice choice = choice_for(bodies, gpu);
      std::uint32_t shares = 0;
      for (const ForceGroup& group : choice.groups) {
        std::uint32_t of_group = 0, moving = 0;
        bool are_whole = true;
        for (std::size_t b = 0; b < bodies.size(); ++b) {
          if (choice.of_bodies[b] != group.variant) continue;
          const std::uint32_t of_body = choice.shares_of(bodies[b], b);
          of_group += of_body;
          moving += bodies[b].moves ? of_body : 0;
          are_whole = are_whole && of_body <= 1;
        }
        CHECK(group.first_share == shares);
        CHECK(group.share_count == of_group);
        CHECK(group.has_whole_bodies == are_whole);
        shares += of_group;
        const ForceVariant& variant = choice.variants[group.variant];
        if (group.all_stages) {
          CHECK(variant.all_stages);
          CHECK((are_whole || (choice.groups.size() == 1 && of_group <= gpu.multiprocessors)));
        }
        if (group.quiet_steps) {
          CHECK(variant.quiet_groups > 0);
          CHECK((are_whole || moving <= variant.quiet_groups));
        }
      }
      std::uint32_t of_bodies = 0;
      for (std::size_t b = 0; b < bodies.size(); ++b) of_bodies += choice.shares_of(bodies[b], b);
      CHECK(shares == of_bodies);
    }
}

TEST_CASE("software that runs shaders has one way for all bodies, and waits for no other group") {
  const std::vector<ForceVariant> variants = gpu::force_variants(software);
  CHECK(std::ranges::all_of(variants, [](const ForceVariant& variant) { return variant.quiet_groups <= 1; }));
  for (const std::uint32_t vertices : {1u, 42u, 162u, 642u, 100'000u})
    for (const std::size_t count : {1u, 20u}) {
      const Choice choice = choice_for(bodies_of(vertices, count, count), software);
      CHECK(choice.of_bodies == std::vector<std::size_t>(count, 0));
      CHECK(choice.groups[0].all_stages == choice.groups[0].has_whole_bodies);
    }
}

}  // namespace
}  // namespace pliant
