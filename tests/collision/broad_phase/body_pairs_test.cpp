// Pairs of bodies whose boxes overlap. The oracle compares each box with each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "collision/collider.hpp"
#include "support/device_bench.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

CollisionDescription found_by(BroadPhase broad_phase, const char* response) {
  CollisionDescription description;
  description.response = {response};
  description.broad_phase = broad_phase;
  return description;
}

// Bodies of one triangle each. Every seventh is static.
ModelAndState triangles(std::size_t count) {
  std::vector<BodySetup> setups;
  for (std::size_t b = 0; b < count; ++b) {
    setups.push_back(soft({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "triangle"));
    if (b % 7 == 6) setups.back().description.kind = BodyKind::immovable;
  }
  return build_model(setups, glm::dvec3(0.0));
}

// Boxes of sizes from 2^least to 2^most, each beside one of those before, so that there are near ones of all sizes. Some are
// flat, and some share corners.
std::vector<glm::vec4> strewn(std::size_t count, int least, int most, float from_origin, std::mt19937& random) {
  std::uniform_int_distribution exponent(least, most);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<glm::vec4> positions;
  std::vector<float> sizes;
  for (std::size_t b = 0; b < count; ++b) {
    sizes.push_back(std::ldexp(1.0f, exponent(random)));
    const std::size_t other = std::uniform_int_distribution<std::size_t>(0, b)(random);
    const glm::vec3 from = other == b ? glm::vec3(from_origin) : glm::vec3(positions[3 * other]);
    const float far = b % 5 == 4 ? 0 : 4 * std::max(sizes[b], sizes[other]);
    const glm::vec3 corner = from + far * glm::vec3(unit(random), unit(random), unit(random));
    positions.emplace_back(corner, 1);
    for (int k = 1; k < 3; ++k)
      positions.emplace_back(corner + sizes[b] * glm::vec3(unit(random), unit(random), b % 4 == 3 ? 0 : unit(random)), 1);
  }
  return positions;
}

Pairs oracle_pairs(const Model& model, const std::vector<glm::vec4>& positions) {
  const std::size_t count = model.bodies.size();
  std::vector<physics::Box> boxes(count);
  for (std::size_t b = 0; b < count; ++b) {
    boxes[b] = physics::empty_box();
    for (std::size_t k = 0; k < 3; ++k) {
      boxes[b].lower = glm::min(boxes[b].lower, glm::vec3(positions[3 * b + k]));
      boxes[b].upper = glm::max(boxes[b].upper, glm::vec3(positions[3 * b + k]));
    }
  }
  Pairs pairs;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (!(model.bodies[a].is_rigid() && model.bodies[b].is_rigid()) && physics::overlaps(boxes[a], boxes[b]))
        pairs.emplace(a, b);
  return pairs;
}

Pairs near_pairs(Device& device, const ModelAndState& start, const std::vector<glm::vec4>& positions, BroadPhase broad_phase) {
  DeviceBodies bodies(device, start.model, start.state);
  bodies.set_time_step(1e-3);
  const Collider collider(bodies, start.model, found_by(broad_phase, "reflect"));
  bodies.world_positions.upload(positions);
  std::vector<glm::uvec4> listed;
  for (int search = 0; search < 2; ++search) {  // the first one leaves nothing behind
    bodies.prepare_search();
    physics::Control control = bodies.control.download().front();
    control.near_pair_count = 0;
    bodies.control.upload(std::span(&control, 1));
    const Pass bounding = collider.bounding_pass(0);
    device.run({&bounding, 1});
    device.run(collider.pairing_passes(0));
    listed = bodies.arrays.get<glm::uvec4>("near_pair").download(0, bodies.control.download().front().near_pair_count);
  }
  Pairs pairs;
  for (const glm::uvec4& pair : listed) pairs.emplace(pair.x, pair.y);
  CHECK(pairs.size() == listed.size());  // none twice
  return pairs;
}

void check_pairs(Device& device, std::size_t bodies) {
  std::mt19937 random(20261126);
  const ModelAndState start = triangles(bodies);
  for (const auto& [least, most] : {std::pair(0, 0), std::pair(-3, 3), std::pair(-20, 0), std::pair(-40, 40)})
    for (const float from_origin : {0.0f, 1000.0f}) {
      CAPTURE(bodies, least, most, from_origin);
      const std::vector<glm::vec4> positions = strewn(bodies, least, most, from_origin, random);
      const Pairs expected = oracle_pairs(start.model, positions);
      CHECK(expected.size() > bodies / 4);
      CHECK(expected.size() < bodies * bodies / 4);
      CHECK(near_pairs(device, start, positions, BroadPhase::grid) == expected);
      CHECK(near_pairs(device, start, positions, BroadPhase::all_pairs) == expected);
    }
}

TEST_CASE("a grid finds the pairs of boxes that overlap, of any size, on any number of threads") {
  for (const unsigned threads : {1u, 4u}) check_pairs(*make_cpu_device(threads, 32), 400);
  check_pairs(*make_cpu_device(1, 64), 60);
}

TEST_CASE("a grid finds the pairs of boxes that overlap, of any size, on a GPU", "[gl]") {
  if (test::lacks_gl()) return;
  check_pairs(*make_gpu_device(0), 400);
}

TEST_CASE("a box as large as numbers go overlaps all others, and one that is not finite none") {
  const ModelAndState start = triangles(40);
  std::mt19937 random(1);
  std::vector<glm::vec4> positions = strewn(40, -2, 2, 0, random);
  for (int k = 0; k < 3; ++k) {
    positions[k] = glm::vec4(glm::vec3(k == 0 ? -2.9e38f : 2.9e38f), 1);
    positions[3 + k] = glm::vec4(glm::vec3(k == 0 ? -2.8e38f : 2.8e38f), 1);
    positions[6 + k].y = std::numeric_limits<float>::quiet_NaN();
  }
  const auto device = make_cpu_device(2, 32);
  const Pairs found = near_pairs(*device, start, positions, BroadPhase::grid);
  CHECK(found == near_pairs(*device, start, positions, BroadPhase::all_pairs));
  for (std::uint32_t b = 0; b < 40; ++b) {
    CHECK(found.contains({0, b}) == (b != 0 && b != 2));
    CHECK((found.contains({2, b}) || found.contains({b, 2})) == false);
  }
}

// Balls of three sizes that fall in a heap on a ground, beside one that flies past fast.
ModelAndState heap() {
  std::vector<BodySetup> setups;
  for (int k = 0; k < 27; ++k) {
    setups.push_back(soft(generate_mesh("icosphere:1"), "ball"));
    BodyDescription& ball = setups.back().description;
    ball.scale = k % 3 == 0 ? 0.2 : k % 3 == 1 ? 0.5 : 0.05;
    ball.position = {1.1 * (k % 3), 1 + 1.1 * (k / 9), 1.1 * (k / 3 % 3)};
    ball.velocity = {0.3 * (k % 2), -2, 0.2};
  }
  setups.back().description.velocity = {-40, -10, -40};
  GroundDescription ground;
  ground.point = {0, 0, 0};
  return build_model(setups, {0, -9.81, 0}, {&ground, 1});
}

TEST_CASE("how pairs of bodies are found does not change a run") {
  const ModelAndState start = heap();
  for (const char* response : {"impulse", "reflect"}) {
    CAPTURE(response);
    ModelAndState from = start;
    if (std::string_view(response) == "reflect") from.model.grounds.clear();
    const auto run = [&](BroadPhase broad_phase, unsigned threads) {
      const auto device = make_cpu_device(threads, 32);
      Simulation simulation(*device, from.model, from.state, plan_of({"verlet", 0.002}), found_by(broad_phase, response));
      simulation.advance(150);
      return std::pair(simulation.state().motion, simulation.report());
    };
    const auto plain = run(BroadPhase::all_pairs, 1), one = run(BroadPhase::grid, 1), three = run(BroadPhase::grid, 3);
    CHECK(plain.second.contact_steps > 0);
    CHECK(plain.second.body_pairs_skipped > 0);
    CHECK(one == plain);
    CHECK(three == plain);
  }
}

// Small bodies that fly through each other's way, from slowly to ten times their size in a step. A few are static.
ModelAndState swarm(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  std::vector<BodySetup> setups;
  for (int b = 0; b < 150; ++b) {
    setups.push_back(soft(generate_mesh("icosphere:0"), "ball"));
    BodyDescription& ball = setups.back().description;
    ball.scale = 0.1;
    ball.position = 1.5 * vector();
    if (b % 10 == 9)
      ball.kind = BodyKind::immovable;
    else
      ball.velocity = std::pow(10, 2 * unit(random)) * vector();
  }
  return build_model(setups, glm::dvec3(0.0));
}

// What limit_step found of a step, without contacts.
struct Limits {
  std::vector<physics::Box> places, velocities;  // of each body [m], [m/s]
  std::vector<physics::Room> rooms;
  std::vector<physics::Cluster> clusters;
  std::vector<physics::Surface> surfaces;
  physics::StepParts parts{};
};

Limits limits_of(const ModelAndState& start, BroadPhase broad_phase, double h) {
  Bench bench(make_cpu_device(2, 32), start, {"verlet", h}, found_by(broad_phase, "impulse"));
  bench.begin();
  for (const Pass& pass : bench.step(0)) {
    if (pass.name == "find_flights") break;
    bench.device->run({&pass, 1});
  }
  const Arrays& arrays = bench.bodies.arrays;
  Limits found;
  for (const physics::BoxBits& box : arrays.get<physics::BoxBits>("place_box").download())
    found.places.push_back(physics::box_of_bits(box));
  for (const physics::BoxBits& box : arrays.get<physics::BoxBits>("body_motion").download())
    found.velocities.push_back(physics::box_of_bits(box));
  found.rooms = arrays.get<physics::Room>("room").download();
  found.clusters = arrays.get<physics::Cluster>("cluster").download();
  found.surfaces = arrays.get<physics::Surface>("surface").download();
  found.parts = arrays.get<physics::StepParts>("step_parts").download().front();
  return found;
}

std::uint32_t island_of(const Limits& found, std::uint32_t b) {
  while (found.clusters[b].island != b) b = found.clusters[b].island;
  return b;
}

bool is_pushed(const physics::Room& room) {
  bool is = false;
  for (int k = 0; k < 3; ++k)
    is = is || physics::from_ordered_bits(room.least_push[k]) < 0 || physics::from_ordered_bits(room.most_push[k]) > 0;
  return is;
}

struct Encounter {
  double distance = 0, speed = 0;  // of two bodies' boxes [m], and how fast they change it at most [m/s]
  double left = -1e30;             // of the distance along some axis, once each has gone its own way [m]
  bool could_touch = true;
};

// In a step h, of which the first part is a part of it.
Encounter encounter_of(const Limits& found, std::uint32_t a, std::uint32_t b, double h, double part) {
  const physics::Box &place = found.places[a], &other = found.places[b], &velocity = found.velocities[a],
                     &against = found.velocities[b];
  glm::dvec3 between(0.0), speed(0.0);
  Encounter e;
  for (int k = 0; k < 3; ++k) {
    const double upward = double(velocity.upper[k]) - against.lower[k], downward = double(against.upper[k]) - velocity.lower[k];
    const double if_above = double(other.lower[k]) - place.upper[k], if_below = double(place.lower[k]) - other.upper[k];
    between[k] = std::max({if_above, if_below, 0.0});
    speed[k] = std::max({upward, downward, 0.0});
    e.could_touch = e.could_touch && if_above < h * std::max(upward, 0.0) && if_below < h * std::max(downward, 0.0);
    const double together = std::max(velocity.upper[k], 0.0f) + std::max(-against.lower[k], 0.0f),
                 apart = std::max(against.upper[k], 0.0f) + std::max(-velocity.lower[k], 0.0f);
    e.left = std::max({e.left, if_above - part * together, if_below - part * apart});
  }
  e.distance = glm::length(between);
  e.speed = glm::length(speed);
  return e;
}

// The oracle looks at every pair, and knows no reaches.
TEST_CASE("bodies that could touch in a step bound it and push each other, and others have room to stay apart") {
  constexpr double h = 0.02;
  int could_touch = 0, are_beside = 0;
  for (const BroadPhase broad_phase : {BroadPhase::grid, BroadPhase::all_pairs})
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
      CAPTURE(seed);
      const ModelAndState start = swarm(seed);
      const Limits found = limits_of(start, broad_phase, h);
      const double longest = std::bit_cast<float>(found.parts.longest);
      for (std::uint32_t a = 0; a < found.places.size(); ++a)
        for (std::uint32_t b = a + 1; b < found.places.size(); ++b) {
          const bool a_moves = found.surfaces[a].inverse_mass > 0, b_moves = found.surfaces[b].inverse_mass > 0;
          if (!a_moves && !b_moves) continue;
          const Encounter e = encounter_of(found, a, b, h, std::min(h, longest));
          const double edge = physics::edge_of_pair(found.surfaces[a], found.surfaces[b]);
          if (e.could_touch) {
            ++could_touch;
            CHECK(longest * e.speed <= (e.distance + 0.25 * edge) * (1 + 1e-6));
            if (a_moves) CHECK(is_pushed(found.rooms[a]));
            if (b_moves) CHECK(is_pushed(found.rooms[b]));
          }
          if (a_moves && b_moves && e.distance <= edge) {
            ++are_beside;
            CHECK(island_of(found, a) == island_of(found, b));
          }
          const double room = (a_moves ? std::bit_cast<float>(found.rooms[a].to_others) : 0) +
                              (b_moves ? std::bit_cast<float>(found.rooms[b].to_others) : 0);
          if (e.left > 0) CHECK(room <= e.left);
        }
    }
  CHECK(could_touch > 200);
  CHECK(are_beside > 100);
}

// The motion after some steps in which no contact takes part.
std::vector<double> undisturbed_motion(const ModelAndState& start, const Method& method, std::uint64_t steps,
                                       const char* response) {
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of(method), found_by(BroadPhase::grid, response));
  simulation.advance(steps);
  CHECK(simulation.report().reverted_vertices == 0);
  return simulation.state().motion;
}

// A body has room for what it does by itself, in steps up to the bound.
TEST_CASE("bodies far from each other move to the bit as without contact, however deformed") {
  for (const auto& [integrator, part_of_bound, stretch] :
       {std::tuple("verlet", 0.95, glm::dvec3(1.5)), std::tuple("cv8", 0.7, glm::dvec3(4, 0.25, 1)),
        std::tuple("rk4", 0.3, glm::dvec3(10)), std::tuple("cv8", 0.7, glm::dvec3(0.2, 2, 2))}) {
    CAPTURE(integrator, part_of_bound, stretch.x);
    std::vector<BodySetup> setups(2, soft(generate_mesh("icosphere:2"), "ball"));
    for (BodySetup& setup : setups) setup.description.stretch = stretch;
    setups[1].description.position = {100, 0, 0};
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    const double bound = step_bound(find_integrator(integrator), start.model.bodies[0], DampingLaw::none);
    const Method method{integrator, part_of_bound * bound};
    CHECK(undisturbed_motion(start, method, 40, "impulse") == undisturbed_motion(start, method, 40, "none"));
  }
}

TEST_CASE("small soft bodies far from each other fall in long steps to the bit as without contact") {
  std::vector<BodySetup> setups(2, soft(generate_mesh("icosphere:2"), "ball"));
  for (BodySetup& setup : setups) {
    setup.description.scale = 0.005;
    setup.description.total_stiffness = 1;
  }
  setups[1].description.position = {100, 0, 0};
  const ModelAndState start = build_model(setups, {0, -9.81, 0});
  const Method method{"verlet", 1.0 / 60};
  CHECK(undisturbed_motion(start, method, 60, "impulse") == undisturbed_motion(start, method, 60, "none"));
}

TEST_CASE("bodies that fly along together in long steps have room, and none is held") {
  std::vector<BodySetup> setups(125, soft(generate_mesh("icosphere:0"), "ball"));
  for (std::size_t b = 0; b < setups.size(); ++b) {
    setups[b].description.scale = 0.1;
    setups[b].description.position = 0.55 * glm::dvec3(b % 5, b / 5 % 5, b / 25);
    setups[b].description.velocity = {0, -20, 0};  // 0.33 m a step, where 0.35 m are between them
  }
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const auto device = make_cpu_device(1, 32);
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 1.0 / 60}), found_by(BroadPhase::grid, "impulse"));
  simulation.advance(20);
  CHECK(simulation.report().held_parts == 0);
  CHECK(simulation.report().substeps == 0);
  CHECK(simulation.report().reverted_vertices == 0);
  CHECK(simulation.report().body_pairs_skipped == 20 * 125 * 124 / 2);  // no two cages meet
}

// Thin triangles beside each other, whose boxes all overlap.
ModelAndState blades(std::size_t count) {
  std::vector<BodySetup> setups;
  for (std::size_t b = 0; b < count; ++b) {
    setups.push_back(soft({{{0, 0, 0}, {1, 1, 1}, {1, 1, 1.001}}, {{0, 1, 2}}}, "blade"));
    setups.back().description.position = 1e-4 * static_cast<double>(b) * glm::dvec3(1, -1, 0);
  }
  return build_model(setups, glm::dvec3(0.0));
}

TEST_CASE("all pairs of up to a thousand bodies may be near") {
  const ModelAndState start = blades(1000);
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 1e-4}), found_by(BroadPhase::automatic, "reflect"));
  simulation.advance(1);
  CHECK(simulation.report().body_pairs_skipped == 0);
  CHECK(simulation.report().contact_steps == 0);
}

TEST_CASE("more near pairs than there is room for are an error that tells it, or hold a step of contact by impulses") {
  const ModelAndState start = blades(1500);
  const auto device = make_cpu_device(2, 32);
  Simulation reflecting(*device, start.model, start.state, plan_of({"verlet", 1e-4}), found_by(BroadPhase::automatic, "reflect"));
  CHECK(error_of([&] { return reflecting.intersections(); }).kind() == ErrorKind::device);
  reflecting.advance(1);
  CHECK(error_of([&] { return reflecting.report(); }).kind() == ErrorKind::device);
  Simulation holding(*device, start.model, start.state, plan_of({"verlet", 1e-4}), found_by(BroadPhase::automatic, "impulse"));
  holding.advance(1);
  CHECK(holding.report().held_parts == 1);
  CHECK(holding.world_positions() == reflecting.world_positions());
}

}  // namespace
}  // namespace pliant
