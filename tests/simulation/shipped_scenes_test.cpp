// The first steps of every shipped scene, on both devices and against brute force. Of scenes with many bodies it takes some.
#include "support/shipped_scenes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "collision/contacts/oracle.hpp"
#include "gl/context.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "support/all_trees.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// The least distance of two bodies' origins, in sums of their radii.
double nearest_distance(const ModelAndState& start) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto origin = [&](std::size_t body) {
    const physics::Pose& frame = start.state.poses[body];
    return glm::dvec3(frame.origin[0], frame.origin[1], frame.origin[2]);
  };
  for (std::size_t a = 0; a < start.model.bodies.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      nearest =
          std::min(nearest, glm::distance(origin(a), origin(b)) / (start.model.bodies[a].radius + start.model.bodies[b].radius));
  return nearest;
}

// Moves bodies into each other and bends them, as if in the middle of a collision.
std::vector<glm::vec4> crowded_positions(const ModelAndState& start) {
  const std::vector<glm::dvec3> world = start.state.world_positions(start.model);
  glm::dvec3 middle(0.0);
  for (const physics::Pose& frame : start.state.poses)
    middle += glm::dvec3(frame.origin[0], frame.origin[1], frame.origin[2]) / static_cast<double>(start.state.poses.size());
  std::vector<glm::vec4> positions;
  const double nearer = 1 - 0.6 / std::max(1.0, nearest_distance(start));
  for (std::size_t i = 0; i < world.size(); ++i) {
    const physics::Pose& frame = start.state.poses[static_cast<std::size_t>(start.model.rest_positions[i].w)];
    const glm::dvec3 shift = nearer * (middle - glm::dvec3(frame.origin[0], frame.origin[1], frame.origin[2]));
    const glm::dvec3 bend(0.03 * std::sin(7 * world[i].y), 0, 0.05 * std::cos(5 * world[i].x));
    positions.emplace_back(glm::vec3(world[i] + shift + bend), 1.0f);
  }
  return positions;
}

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

PairSet as_set(const std::vector<glm::uvec2>& pairs) {
  PairSet set;
  for (const glm::uvec2& pair : pairs) set.emplace(std::min(pair.x, pair.y), std::max(pair.x, pair.y));
  return set;
}

// Adds every triangle of one leaf with every triangle of the other.
void add_pairs(PairSet& pairs, const Forest& forest, const TreeNode& a, const TreeNode& b) {
  for (std::uint32_t i = a.first_triangle; i < a.end_of_triangles(); ++i)
    for (std::uint32_t j = b.first_triangle; j < b.end_of_triangles(); ++j) {
      const auto [s, t] = std::minmax(forest.triangle_ids[i], forest.triangle_ids[j]);
      pairs.emplace(s, t);
    }
}

// The touching pairs among those that the device's tree search lists.
PairSet pairs_by_tree(Device& device, const ModelAndState& start, const CollisionDescription& description,
                      const std::vector<glm::vec4>& positions) {
  DeviceBodies bodies(device, start.model, start.state);
  Collider collider(bodies, start.model, description);
  bodies.world_positions.upload(positions);
  bodies.prepare_search();
  const Pass bounding = collider.bounding_pass(0);
  device.run({&bounding, 1});
  device.run(collider.search_passes(0));
  const Forest& forest = collider.forest();
  const PairSet all = as_set(intersecting_pairs(start.model, positions, description.triangle_test));
  PairSet listed;
  for (const glm::uvec2& pair : collider.trees().leaf_pairs())
    add_pairs(listed, forest, forest.nodes[pair.x], forest.nodes[pair.y]);
  PairSet found;
  std::set_intersection(listed.begin(), listed.end(), all.begin(), all.end(), std::inserter(found, found.end()));
  CHECK(bodies.control.download().front().count[physics::contact_pairs] == all.size());
  return found;
}

TEST_CASE("on every shipped scene the trees find the pairs that brute force finds", "[gl]") {
  for (const SceneDescription& scene : test::load_thinned_scenes()) {
    if (scene.bodies.size() < 2) continue;  // there are no pairs
    const ModelAndState start = build_model(load_bodies(scene), glm::dvec3(0.0));
    const std::vector<glm::vec4> positions = crowded_positions(start);
    const PairSet all = as_set(intersecting_pairs(start.model, positions, scene.collision.triangle_test));
    CAPTURE(scene.file.string());
    CHECK(all.size() > 20);
    for (const TestDevice& test : all_devices()) {
      for (const TreeDescription& tree : test::all_trees()) {
        CAPTURE(test.name, tree.split, tree.fan_out, tree.refit);
        CollisionDescription collision = scene.collision;
        collision.tree = tree;
        CHECK(pairs_by_tree(*test.device, start, collision, positions) == all);
      }
    }
  }
}

// Dents a body as a contact would, so that all its modes move.
State dented(const ModelAndState& start) {
  State state = start.state;
  for (std::size_t i = 0; i < start.model.rest_positions.size(); ++i) {
    const glm::vec4& rest = start.model.rest_positions[i];
    const double radius = start.model.bodies[static_cast<std::size_t>(rest.w)].radius;
    state.motion[6 * i] -= 0.2 * radius * std::max(0.0, static_cast<double>(rest.x) / radius - 0.5);
    state.motion[6 * i + 4] += 0.1 * static_cast<double>(rest.z);
  }
  return state;
}

// The largest distance of two vertices' world positions, in radii of their body.
double largest_difference(const Model& model, const State& a, const State& b) {
  const std::vector<glm::dvec3> p = a.world_positions(model), q = b.world_positions(model);
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) largest = larger(largest, glm::length(p[i] - q[i]) / model.body_of(i).radius);
  return largest;
}

// Steps of the scene's own plan before its bodies first touch, forty at most.
std::uint64_t smooth_steps(const SceneDescription& scene, const ModelAndState& start) {
  const auto device = make_cpu_device(2, 32);
  Simulation simulation(*device, start.model, start.state, plan_time(scene, start.model), scene.collision);
  std::uint64_t steps = 0;
  for (; steps < 40; ++steps) {
    simulation.advance(1);
    if (simulation.report().contact_steps > 0) break;
  }
  return steps;
}

TEST_CASE("until the first contact every shipped scene is the fp64 one to 1e-5 of the body", "[gl][long]") {
  std::size_t scenes_touching_at_once = 0;
  for (const SceneDescription& scene : test::load_thinned_scenes()) {
    const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
    const TimePlan plan = plan_time(scene, start.model);
    const std::uint64_t steps = smooth_steps(scene, start);
    CAPTURE(scene.file.string(), steps);
    scenes_touching_at_once += steps == 0;
    const auto end_on = [&](Device& device) {
      Simulation simulation(device, start.model, start.state, plan, scene.collision);
      simulation.advance(steps);
      CHECK(simulation.report().contact_steps == 0);
      return simulation.state();
    };
    const State exact = end_on(*make_cpu_device(2, 64));
    for (const TestDevice& test : all_devices()) {
      if (test.rounding < 1e-12) continue;
      CAPTURE(test.name);
      CHECK(largest_difference(start.model, exact, end_on(*test.device)) < 1e-5);
    }
  }
  CHECK(scenes_touching_at_once <= 2);  // bunnies_overdamped, fast_spheres
}

TEST_CASE("dented bodies of every scene with reflection move as in fp64 to 1e-5 of the body", "[gl][long]") {
  for (const SceneDescription& scene : test::load_reflecting_scenes()) {
    ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity);
    start.state = dented(start);
    CAPTURE(scene.file.string());
    // The step is within the bound, because beyond it rounding grows with everything else.
    const TimePlan plan = plan_time(scene, start.model);
    const Method method{plan.integrator->name, std::min(plan.time_step, 0.9 * plan.step_bound), damping_law_of(scene)};
    const State exact = evolve(*make_cpu_device(2, 64), start, method, 8);
    for (const TestDevice& test : all_devices()) {
      if (test.rounding < 1e-12) continue;
      CAPTURE(test.name);
      CHECK(largest_difference(start.model, exact, evolve(*test.device, start, method, 8)) < 1e-5);
    }
  }
}

// As they ship they take a GPU. Coarser ones show that they begin well.
TEST_CASE("the dense scenes have clustered bodies that fall and meet") {
  for (const auto& [name, coarser] : {std::pair{"bunny", "body.bunny.subdivide=0"}, {"sphere", "body.large.mesh=icosphere:4"}}) {
    CAPTURE(name);
    const SceneDescription shipped = test::load_shipped_scene(std::string("dense/") + name);
    CHECK(shipped.bodies[0].force_tolerance == 1e-3);
    const SceneDescription scene = test::load_shipped_scene(
        std::string("dense/") + name, std::vector<std::string>{coarser, "body." + shipped.bodies[0].name + ".forces=clustered"});
    const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
    const auto device = make_cpu_device(2, 32);
    const TimePlan plan = plan_time(scene, start.model);
    Simulation simulation(*device, start.model, start.state, plan, scene.collision);
    simulation.advance(static_cast<std::uint64_t>(0.7 / plan.time_step));
    const StepReport report = simulation.report();
    CHECK_FALSE(report.breakdown.has_value());
    CHECK(report.contact_steps > 0);
    REQUIRE(report.clusters.has_value());
    CHECK(report.clusters->checks > 0);
    CHECK(report.clusters->largest_excess < 10);
    CHECK(simulation.intersections().pairs == 0);
  }
}

}  // namespace
}  // namespace pliant
