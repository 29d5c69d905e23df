// Keys of scenes are few, and their angles may differ by any number of turns. Devices get more keys: quaternions between two of
// them are interpolated well if they are less than most_turn apart.
#include "model/body_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/expect.hpp"
#include "core/larger.hpp"
#include "model/body_error.hpp"

namespace pliant {
namespace {

constexpr double most_turn = 15;            // between two keys of a device, at the highest rate on the way [degrees]
constexpr std::size_t most_keys = 100'000;  // of a device
constexpr std::size_t numbers_of_key = 6;
using Numbers = std::array<double, numbers_of_key>;  // position [m], then angles [degrees]

// A key of the scene with its rates.
struct Key {
  double time;
  Numbers at, rate{};
};

Key key_of(const PathKeyDescription& key) {
  return {.time = key.time,
          .at = {key.position.x, key.position.y, key.position.z, key.rotation.x, key.rotation.y, key.rotation.z}};
}

// The harmonic mean of the slopes on both sides, weighted by the ways. 0 where they have different signs.
double monotone_rate(double before, double slope_before, double after, double slope_after) {
  if (slope_before * slope_after <= 0) return 0;
  const double weight_before = 2 * after + before, weight_after = after + 2 * before;
  return (weight_before + weight_after) / (weight_before / slope_before + weight_after / slope_after);
}

void find_rates(std::vector<Key>& keys, bool repeats) {
  const std::size_t segments = keys.size() - 1;
  const auto duration = [&](std::size_t s) { return keys[s + 1].time - keys[s].time; };
  const auto slope = [&](std::size_t s, std::size_t n) { return (keys[s + 1].at[n] - keys[s].at[n]) / duration(s); };
  for (std::size_t k = 0; k <= segments; ++k) {
    const bool is_end = k == 0 || k == segments;
    if (is_end && !repeats) continue;
    const std::size_t before = k == 0 ? segments - 1 : k - 1, after = k == segments ? 0 : k;
    for (std::size_t n = 0; n < numbers_of_key; ++n)
      keys[k].rate[n] = monotone_rate(duration(before), slope(before, n), duration(after), slope(after, n));
  }
}

Key key_between(const Key& a, const Key& b, double time) {
  const double duration = b.time - a.time, s = (time - a.time) / duration;
  Key key{.time = time, .at = {}};
  for (std::size_t n = 0; n < numbers_of_key; ++n) {
    key.at[n] = physics::cubic(a.at[n], b.at[n], a.rate[n], b.rate[n], s, duration);
    key.rate[n] = physics::rate_of_cubic(a.at[n], b.at[n], a.rate[n], b.rate[n], s, duration);
  }
  return key;
}

// The time at which the keys say where the path is at a time. Before the first key it is that time.
double time_along(const std::vector<Key>& keys, double time, bool repeats) {
  physics::Path way{};
  way.repeats = repeats ? 1 : 0;
  return std::min(time, physics::time_along(way, time, keys.front().time, keys.back().time));
}

// The keys from a time along them on, or once around if they repeat. Times that differ by rounding are the same.
std::vector<Key> keys_from(const std::vector<Key>& keys, double from, bool repeats) {
  const double duration = keys.back().time - keys.front().time, near = 1e-9 * duration;
  const auto next = std::ranges::find_if(keys, [&](const Key& key) { return key.time > from + near; });
  std::vector<Key> left(next, keys.end());
  if (next == keys.begin()) return left;
  const Key& before = *(next - 1);
  Key now = from - before.time <= near ? before : key_between(before, *next, from);
  now.time = from;
  left.insert(left.begin(), now);
  if (!repeats || from <= keys.front().time + near) return left;
  const auto add_next_time = [&](Key key) {
    key.time += duration;
    for (std::size_t n = 3; n < numbers_of_key; ++n) key.at[n] += keys.back().at[n] - keys.front().at[n];
    left.push_back(key);
  };
  for (auto key = keys.begin() + 1; key->time < from - near; ++key) add_next_time(*key);
  add_next_time(now);
  return left;
}

glm::dquat about(int axis, double radians) {
  glm::dvec3 direction(0.0);
  direction[axis] = 1;
  return glm::angleAxis(radians, direction);
}

// The derivative of a quaternion that turns about the axis.
glm::dquat rate_about(int axis, double radians, double rate) { return about(axis, radians + std::numbers::pi) * (0.5 * rate); }

physics::PathKey device_key(const Key& key, const glm::dquat& first_rotation) {
  physics::PathKey result{};
  result.time = key.time;
  std::copy_n(key.at.begin(), 3, result.position);
  std::copy_n(key.rate.begin(), 3, result.velocity);
  std::array<glm::dquat, 3> turn, rate;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    const double angle = glm::radians(key.at[3 + n]);
    turn[n] = about(axis, angle);
    rate[n] = rate_about(axis, angle, glm::radians(key.rate[3 + n]));
  }
  const auto& [x, y, z] = turn;
  const glm::dquat at = z * y * x * first_rotation,
                   change = (rate[2] * y * x + z * rate[1] * x + z * y * rate[0]) * first_rotation;
  const double numbers[] = {at.x, at.y, at.z, at.w}, rates[] = {change.x, change.y, change.z, change.w};
  std::ranges::copy(numbers, result.quaternion);
  std::ranges::copy(rates, result.quaternion_rate);
  return result;
}

// All three angles together bound the turn. A cubic is fastest at an end or half-way, where it has 1.5 times its mean rate at
// most.
std::size_t pieces_between(const Key& a, const Key& b) {
  double turn = 0;
  for (std::size_t n = 3; n < numbers_of_key; ++n) {
    const double fastest_end = std::max(std::abs(a.rate[n]), std::abs(b.rate[n])) * (b.time - a.time);
    turn += std::max(1.5 * std::abs(b.at[n] - a.at[n]), fastest_end);
  }
  return static_cast<std::size_t>(std::min(std::ceil(turn / most_turn), 1e9)) + 1;
}

void expect_few_keys(const BodyDescription& description, const std::vector<Key>& keys) {
  std::size_t pieces = 0;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) pieces += pieces_between(keys[k], keys[k + 1]);
  if (pieces > most_keys)
    throw body_error(description,
                     fmt::format("its path needs {} keys at {:g} degrees from each to the next, but may have {}", pieces,
                                 most_turn, most_keys),
                     "let it turn less, or leave keys out");
}

std::vector<physics::PathKey> device_keys(const std::vector<Key>& keys, const glm::dquat& first_rotation) {
  std::vector<physics::PathKey> result;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const std::size_t pieces = pieces_between(keys[k], keys[k + 1]);
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      const double part = static_cast<double>(piece) / static_cast<double>(pieces);
      const double time = keys[k].time + part * (keys[k + 1].time - keys[k].time);
      result.push_back(device_key(piece == 0 ? keys[k] : key_between(keys[k], keys[k + 1], time), first_rotation));
    }
  }
  result.push_back(device_key(keys.back(), first_rotation));
  return result;
}

BodyPath path_by_keys(const BodyDescription& description, const glm::dvec3& centroid) {
  std::vector<Key> keys;
  for (PathKeyDescription key : description.path) {
    key.position += description.position;
    keys.push_back(key_of(key));
  }
  find_rates(keys, description.repeats);
  expect_few_keys(description, keys);
  BodyPath path;
  path.keys = device_keys(keys, rotation_of(description.rotation));
  path.way.repeats = description.repeats ? 1 : 0;
  STORE3(path.way.arm, 0, centroid);
  return path;
}

// One turn about the spin's axis, which repeats. The body's centre stays in its place, but for the drift.
std::vector<physics::PathKey> keys_of_spin(const glm::dvec3& centre, const glm::dquat& rotation, const glm::dvec3& spin) {
  constexpr double turns_of_keys = 360 / most_turn;
  const double rate = glm::length(spin), period = rate > 0 ? 2 * std::numbers::pi / rate : 1;
  std::vector<physics::PathKey> keys;
  const auto count = static_cast<std::uint32_t>(rate > 0 ? turns_of_keys : 1);
  for (std::uint32_t k = 0; k <= count; ++k) {
    physics::PathKey& key = keys.emplace_back();
    key.time = period * k / count;
    STORE3(key.position, 0, centre);
    const glm::dquat turn = rate > 0 ? glm::angleAxis(rate * key.time, spin / rate) : glm::dquat(1, 0, 0, 0);
    const glm::dquat at = turn * rotation, change = glm::dquat(0, 0.5 * spin) * at;
    const double numbers[] = {at.x, at.y, at.z, at.w}, rates[] = {change.x, change.y, change.z, change.w};
    std::ranges::copy(numbers, key.quaternion);
    std::ranges::copy(rates, key.quaternion_rate);
  }
  return keys;
}

BodyPath path_by_motion(const BodyDescription& description, const glm::dvec3& centroid) {
  const glm::dquat rotation = rotation_of(description.rotation);
  BodyPath path;
  path.keys = keys_of_spin(description.position + rotation * centroid, rotation, description.spin);
  path.way.repeats = description.spin != glm::dvec3(0.0) ? 1 : 0;
  STORE3(path.way.drift, 0, description.velocity);
  return path;
}

// The largest of a number at keys and half-way between them.
template <class Number>
double largest_along(const BodyPath& path, Number number) {
  double largest = 0;
  for (std::size_t k = 0; k + 1 < path.keys.size(); ++k)
    for (const double part : {0.0, 0.5, 1.0})
      largest = larger(largest, number(path.at(path.keys[k].time + part * (path.keys[k + 1].time - path.keys[k].time))));
  return largest;
}

}  // namespace

physics::PathPoint BodyPath::at(double time) const {
  const double along = physics::time_along(way, time, keys.front().time, keys.back().time);
  const auto next = std::ranges::upper_bound(keys.begin() + 1, keys.end() - 1, along, {}, &physics::PathKey::time);
  return physics::point_of_body(way, physics::point_between(*(next - 1), *next, along), time);
}

double BodyPath::fastest_spin() const {
  return largest_along(*this, [](const physics::PathPoint& p) { return glm::length(glm::make_vec3(p.spin)); });
}

double BodyPath::highest_speed() const {
  return largest_along(*this, [](const physics::PathPoint& p) { return glm::length(glm::make_vec3(p.velocity)); });
}

glm::dquat rotation_of(const glm::dvec3& degrees) {
  const glm::dvec3 angle = glm::radians(degrees);
  return glm::normalize(about(2, angle.z) * about(1, angle.y) * about(0, angle.x));
}

// By atan2 alone, which keeps every digit where the second angle is a right one and the other two turn alike.
glm::dvec3 degrees_of(const glm::dquat& rotation) {
  const glm::dmat3 m = glm::mat3_cast(rotation);  // columns first
  const double z = std::atan2(m[0].y, m[0].x), sine = std::sin(z), cosine = std::cos(z);
  const double y = std::atan2(-m[0].z, std::hypot(m[0].x, m[0].y));
  const double x = std::atan2(sine * m[2].x - cosine * m[2].y, cosine * m[1].y - sine * m[1].x);
  return glm::degrees(glm::dvec3(x, y, z));
}

std::vector<PathKeyDescription> path_from(const BodyDescription& description, double time) {
  std::vector<Key> keys(description.path.size());
  std::ranges::transform(description.path, keys.begin(), key_of);
  find_rates(keys, description.repeats);
  const double from = time_along(keys, time, description.repeats);
  std::vector<PathKeyDescription> left;
  for (const Key& key : keys_from(keys, from, description.repeats))
    left.push_back(
        {.time = key.time - from, .position = {key.at[0], key.at[1], key.at[2]}, .rotation = {key.at[3], key.at[4], key.at[5]}});
  return left;
}

std::vector<physics::PathKey> keys_toward(const BodyPath& path, const physics::PathState& now, const glm::dvec3& centre,
                                          double seconds) {
  PLIANT_EXPECT(path.way.repeats == 0 && path.keys.size() >= 2 && seconds > 0);
  const physics::PathPoint& at = now.now;
  const glm::dquat rotation(at.quaternion[3], at.quaternion[0], at.quaternion[1], at.quaternion[2]);
  const glm::dvec3 arm = rotation * glm::make_vec3(path.way.arm);
  const glm::dvec3 from = glm::make_vec3(at.centre) - arm, to = centre - arm, velocity = now.pace * glm::make_vec3(at.velocity);
  std::vector<physics::PathKey> keys(path.keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    physics::PathKey& key = keys[k];
    key.time = static_cast<double>(k) * seconds;  // later keys than the second one rest
    STORE3(key.position, 0, (k == 0 ? from : to))
    STORE3(key.velocity, 0, (k == 0 ? velocity : glm::dvec3(0.0)))
    std::ranges::copy(at.quaternion, key.quaternion);
  }
  return keys;
}

BodyPath make_path(const BodyDescription& description, const glm::dvec3& centroid) {
  PLIANT_EXPECT(description.path.size() != 1);
  BodyPath path = description.path.empty() ? path_by_motion(description, centroid) : path_by_keys(description, centroid);
  path.way.key_count = static_cast<std::uint32_t>(path.keys.size());
  return path;
}

}  // namespace pliant
