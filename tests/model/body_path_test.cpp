// Paths of scripted bodies: where they lead, and how fast.
#include "model/body_path.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

namespace pliant {
namespace {

BodyDescription scripted(std::vector<PathKeyDescription> keys, bool repeats = false) {
  BodyDescription description;
  description.kind = BodyKind::scripted;
  description.path = std::move(keys);
  description.repeats = repeats;
  return description;
}

glm::dquat rotation_at(const BodyPath& path, double time) {
  const physics::PathPoint p = path.at(time);
  return {p.quaternion[3], p.quaternion[0], p.quaternion[1], p.quaternion[2]};
}

// Where a point of the body is that stands so beside the centre when the body is not turned.
glm::dvec3 place_of(const BodyPath& path, double time, const glm::dvec3& point) {
  return glm::make_vec3(path.at(time).centre) + rotation_at(path, time) * point;
}

// With the second of the keys' three angles in another turn than the first.
const std::vector<PathKeyDescription> winding = {{0, {0, 0, 0}, {0, 0, 0}},
                                                 {0.5, {1, 2, -1}, {20, -200, 10}},
                                                 {1.25, {1, 2.5, 0}, {400, -250, 10}},
                                                 {2, {0, 0, 0}, {360, -360, 0}}};

TEST_CASE("a path leads through its keys") {
  BodyDescription description = scripted(winding);
  description.position = {3, 0, 1};
  description.rotation = {0, 40, 5};
  const glm::dvec3 centroid{0.2, -0.1, 0.3};
  const BodyPath path = make_path(description, centroid);
  for (const PathKeyDescription& key : winding) {
    const glm::dquat turn = rotation_of(key.rotation) * rotation_of(description.rotation);
    const glm::dvec3 centre = description.position + key.position + turn * centroid;
    CHECK(glm::length(glm::make_vec3(path.at(key.time).centre) - centre) < 1e-12);
    for (const glm::dvec3& point : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
      CHECK(glm::length(place_of(path, key.time, point) - (centre + turn * point)) < 1e-12);
  }
}

TEST_CASE("a path's velocity and spin are how fast its places change") {
  const glm::dvec3 centroid{0.2, -0.1, 0.3};
  for (const bool repeats : {false, true}) {
    CAPTURE(repeats);
    const BodyPath path = make_path(scripted(winding, repeats), centroid);
    for (double time = 0.01; time < 5; time += 0.0371) {
      CAPTURE(time);
      constexpr double apart = 1e-5;
      const physics::PathPoint p = path.at(time);
      for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
        const glm::dvec3 slope = (place_of(path, time + apart, point) - place_of(path, time - apart, point)) / (2 * apart);
        const glm::dvec3 velocity =
            glm::make_vec3(p.velocity) + glm::cross(glm::make_vec3(p.spin), rotation_at(path, time) * point);
        CHECK(glm::length(slope - velocity) < 1e-4 * (1 + glm::length(velocity)));  // accelerations jump at keys
      }
    }
  }
}

TEST_CASE("a path that does not repeat begins and ends at rest, and rests between equal keys") {
  const BodyPath path =
      make_path(scripted({{0.5, {0, 1, 0}, {}}, {1, {0, 2, 0}, {90, 0, 0}}, {2, {0, 2, 0}, {90, 0, 0}}, {3, {1, 2, 0}, {}}}),
                {0.1, 0.2, 0.3});
  for (const auto& [from, to] : {std::pair(0.0, 0.5), std::pair(1.0, 2.0), std::pair(3.0, 9.0)}) {
    const physics::PathPoint before = path.at(from);
    for (double time = from; time <= to; time += 0.0625) {
      const physics::PathPoint p = path.at(time);
      CHECK(std::ranges::equal(p.centre, before.centre));
      CHECK(std::ranges::equal(p.quaternion, before.quaternion));
      CHECK((glm::make_vec3(p.velocity) == glm::dvec3(0.0) && glm::make_vec3(p.spin) == glm::dvec3(0.0)));
    }
  }
}

TEST_CASE("nothing overshoots a key") {
  const BodyPath path =
      make_path(scripted({{0, {0, 0, 0}, {}}, {0.1, {1, 0, 0}, {}}, {2, {1.1, 1, 0}, {}}, {2.1, {1.1, 0, 0}, {}}}), {});
  double before = -1;
  for (double time = 0; time <= 2.1; time += 0.001) {
    const glm::dvec3 at = glm::make_vec3(path.at(time).centre);
    CHECK(at.x >= before);
    CHECK((at.x <= 1.1 && at.y >= 0 && at.y <= 1));
    before = at.x;
  }
}

TEST_CASE("a key's angles may be any number of turns away") {
  const BodyPath path = make_path(scripted({{0, {}, {}}, {1, {}, {0, 720, 0}}}), {});
  double turned = 0;
  for (int k = 0; k < 1000; ++k) turned += path.at((k + 0.5) / 1000).spin[1] / 1000;
  CHECK(turned == Approx(4 * std::numbers::pi).epsilon(1e-5));
}

TEST_CASE("a path that repeats goes on as it began") {
  const BodyPath path = make_path(scripted(winding, true), {0.2, -0.1, 0.3});
  for (double time = 0.3; time < 2; time += 0.17)
    for (const double turns : {1.0, 2.0, 1000.0})
      CHECK(glm::length(place_of(path, time + 2 * turns, {0, 1, 0}) - place_of(path, time, {0, 1, 0})) < 1e-9);
  const physics::PathPoint end = path.at(2 - 1e-9), begin = path.at(2 + 1e-9);
  CHECK(glm::length(glm::make_vec3(end.velocity) - glm::make_vec3(begin.velocity)) < 1e-6);
  CHECK(glm::length(glm::make_vec3(end.spin) - glm::make_vec3(begin.spin)) < 1e-6);
}

TEST_CASE("angles of a rotation make that rotation, also where two axes are the same") {
  for (const glm::dvec3& degrees : {glm::dvec3(10, 20, 30), glm::dvec3(-170, 89, 200), glm::dvec3(30, 90, 10),
                                    glm::dvec3(40, -90, 0), glm::dvec3(5, 90 - 1e-9, 7)}) {
    CAPTURE(degrees.x, degrees.y);
    const glm::dquat rotation = rotation_of(degrees), again = rotation_of(degrees_of(rotation));
    for (const glm::dvec3& point : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
      CHECK(glm::distance(rotation * point, again * point) < 1e-14);
  }
}

TEST_CASE("what is left of a path leads through the same keys from the same place on") {
  for (const bool repeats : {false, true})
    for (const double time : {0.0, 0.2, 0.5, 0.9, 1.25, 1.9999, 2.0, 2.3, 5.25}) {
      CAPTURE(repeats, time);
      const BodyDescription description = scripted(winding, repeats);
      const std::vector<PathKeyDescription> left = path_from(description, time);
      const BodyPath path = make_path(description, {0.2, -0.1, 0.3});
      if (!repeats && time >= 2) {
        CHECK((left.size() == 1 && left.front().position == winding.back().position));
        continue;
      }
      REQUIRE(left.size() >= 2);
      const BodyPath rest = make_path(scripted(left, repeats), {0.2, -0.1, 0.3});
      for (const PathKeyDescription& key : left)
        CHECK(glm::distance(place_of(rest, key.time, {0, 1, 0}), place_of(path, time + key.time, {0, 1, 0})) < 1e-4);
      if (repeats) CHECK((left.back().time == Approx(2) && left.back().position == left.front().position));
    }
}

TEST_CASE("a path that has not begun is left whole") {
  const std::vector<PathKeyDescription> left = path_from(scripted({{1, {0, 1, 0}, {}}, {3, {0, 2, 0}, {}}}), 0.25);
  CHECK(left == std::vector<PathKeyDescription>{{0.75, {0, 1, 0}, {}}, {2.75, {0, 2, 0}, {}}});
  CHECK(path_from(scripted(winding), 0) == winding);
}

TEST_CASE("a scripted body without keys keeps its velocity and its spin about the centroid") {
  BodyDescription description;
  description.kind = BodyKind::scripted;
  description.position = {1, 2, 3};
  description.rotation = {0, 0, 30};
  description.velocity = {1, 0, -2};
  description.spin = {1, 2, -2};
  const glm::dvec3 centroid{0.3, 0, 0}, axis = description.spin / 3.0;
  const BodyPath path = make_path(description, centroid);
  const glm::dquat rotation = rotation_of(description.rotation);
  for (const double time : {0.0, 0.1, 1.0, 2.2, 100.0}) {
    CAPTURE(time);
    const glm::dvec3 centre = description.position + rotation * centroid + time * description.velocity;
    const glm::dvec3 point = glm::angleAxis(3 * time, axis) * rotation * glm::dvec3(0, 1, 0);
    CHECK(glm::length(glm::make_vec3(path.at(time).centre) - centre) < 1e-12 * (1 + time));
    CHECK(glm::length(place_of(path, time, {0, 1, 0}) - centre - point) < 2e-6);
    CHECK(glm::length(glm::make_vec3(path.at(time).spin) - description.spin) < 3e-5);
  }
}

TEST_CASE("a body that is sent elsewhere goes on as it went, arrives in time and rests, without a turn") {
  BodyDescription description = scripted(winding);
  description.position = {3, 0, 1};
  const BodyPath path = make_path(description, {0.2, -0.1, 0.3});
  physics::PathState now{};
  now.now = path.at(0.8);
  now.pace = 0.5;
  const glm::dvec3 target{7, 8, 9};
  BodyPath sent = path;
  sent.keys = keys_toward(path, now, target, 0.25);
  CHECK(sent.keys.size() == path.keys.size());
  const physics::PathPoint begin = sent.at(0), end = sent.at(0.25), later = sent.at(10);
  CHECK(glm::distance(glm::make_vec3(begin.centre), glm::make_vec3(now.now.centre)) < 1e-14);
  CHECK(glm::distance(glm::make_vec3(begin.velocity), 0.5 * glm::make_vec3(now.now.velocity)) < 1e-12);
  for (const physics::PathPoint& p : {end, later}) {
    CHECK(glm::distance(glm::make_vec3(p.centre), target) < 1e-14);
    CHECK(glm::length(glm::make_vec3(p.velocity)) < 1e-12);
  }
  for (const double time : {0.0, 0.1, 0.2, 0.5}) {
    CHECK(glm::length(glm::make_vec3(sent.at(time).spin)) < 1e-12);
    CHECK(std::abs(glm::dot(rotation_at(sent, time), rotation_at(path, 0.8))) > 1 - 1e-12);
  }
}

}  // namespace
}  // namespace pliant
