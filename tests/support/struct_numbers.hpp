// What the structs of arrays hold, as numbers that two devices can be compared by. Paddings are left out, and so is what differs
// by the order of threads.
#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include "state/arrays.hpp"

namespace pliant {

inline std::vector<double> numbers_of(const physics::Pose& pose) {
  std::vector<double> numbers(sizeof(physics::Pose) / sizeof(double));
  std::memcpy(numbers.data(), &pose, sizeof(physics::Pose));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::FrameChange& change) {
  std::vector<double> numbers(offsetof(physics::FrameChange, turned) / sizeof(double));
  std::memcpy(numbers.data(), &change, numbers.size() * sizeof(double));
  numbers.push_back(change.turned);
  return numbers;
}

inline std::vector<double> numbers_of(const physics::BoxBits& box) {
  std::vector<double> numbers;
  const bool is_empty = box.lower[0] > box.upper[0];
  for (const auto& corner : {box.lower, box.upper})
    for (int k = 0; k < 3; ++k) numbers.push_back(is_empty ? double(corner[k]) : physics::from_ordered_bits(corner[k]));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::Room& room) {
  const auto to_others = static_cast<double>(std::bit_cast<float>(room.to_others));
  std::vector<double> numbers{std::isinf(to_others) ? 1e30 : to_others};
  for (const auto& push : {room.least_push, room.most_push})
    for (int k = 0; k < 3; ++k) numbers.push_back(physics::from_ordered_bits(push[k]));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::Status& status) {
  return {double(status.activity),     double(status.non_finite_vertex),
          double(status.deformed),     double(status.force_stale),
          double(status.calm),         double(status.disturbed),
          double(status.slow_for),     double(status.pressed_by_static),
          double(status.falls_asleep), double(status.asleep),
          double(status.steps_to_star)};
}

inline std::vector<double> numbers_of(const physics::Tally& tally) {
  return {double(tally.force_evaluations), double(tally.forces_skipped), double(tally.frame_changes), double(tally.steps_at_rest),
          double(tally.steps_asleep)};
}

inline std::vector<double> numbers_of(const physics::Moments& moments) {
  std::vector<double> numbers(sizeof(physics::Moments) / sizeof(double));
  std::memcpy(numbers.data(), &moments, sizeof(physics::Moments));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::PartSums& sums) {
  std::vector<double> numbers = numbers_of(sums.moments);
  numbers.insert(numbers.end(), std::begin(sums.lost_turning), std::end(sums.lost_turning));
  numbers.insert(numbers.end(), {sums.deformation, sums.rigid, sums.missed, sums.gained, double(sums.cuts),
                                 double(sums.involvement), double(sums.parts_too_fast)});
  return numbers;
}

inline std::vector<double> numbers_of(const physics::RigidMotion& motion) {
  std::vector<double> numbers(sizeof(physics::RigidMotion) / sizeof(double));
  std::memcpy(numbers.data(), &motion, sizeof(physics::RigidMotion));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::Control& control) {
  std::vector<double> numbers{control.time_step, control.time_left};
  std::uint32_t words[(sizeof(physics::Control) - offsetof(physics::Control, step)) / 4];
  std::memcpy(words, &control.step, sizeof(words));
  numbers.insert(numbers.end(), std::begin(words), std::end(words));
  return numbers;
}

inline std::vector<double> numbers_of(const physics::Pace& pace) {
  static_assert(sizeof(physics::Pace) == offsetof(physics::Pace, error) + 16 * sizeof(std::uint32_t));  // all of them are below
  std::vector<double> numbers(offsetof(physics::Pace, error) / sizeof(double));
  std::memcpy(numbers.data(), &pace, numbers.size() * sizeof(double));
  for (const std::uint32_t error : {pace.error, pace.lowest_error}) numbers.push_back(std::bit_cast<float>(error));
  for (const std::uint32_t side : {pace.least_x, pace.least_y, pace.least_z, pace.most_x, pace.most_y, pace.most_z})
    numbers.push_back(side);
  for (const std::uint32_t count : {pace.estimate_order, pace.verdict, pace.accepted, pace.rejected, pace.rejected_in_contact,
                                    pace.rejected_before, pace.failure, pace.is_too_slow})
    numbers.push_back(count);
  return numbers;
}

inline std::vector<double> numbers_of(const physics::ContactList& list) {
  return {list.last_part,
          double(list.triangle_pair_count),
          double(list.contact_count),
          double(list.uncertified),
          double(list.rounds_that_cut),
          double(list.arrivals),
          double(list.latest_count),
          double(list.is_tried),
          double(list.has_dues),
          double(std::bit_cast<float>(list.fastest)),
          double(std::bit_cast<float>(list.heaviest))};
}

inline std::vector<double> numbers_of(const physics::PathState& state) {
  std::vector<double> numbers(offsetof(physics::PathState, waits) / sizeof(double));
  std::memcpy(numbers.data(), &state, numbers.size() * sizeof(double));
  numbers.push_back(state.waits);
  return numbers;
}

inline std::vector<double> numbers_of(const physics::Debt& debt) {
  return {debt.energy, debt.lost[0], debt.lost[1], debt.lost[2], double(debt.is_for_cuts)};
}

// The next one in a list depends on threads.
inline std::vector<double> numbers_of(const physics::GridEntry& entry) {
  std::vector<double> numbers(entry.lower, entry.lower + 3);
  numbers.insert(numbers.end(), entry.upper, entry.upper + 3);
  numbers.push_back(entry.level);
  return numbers;
}

// Its motion means nothing if it does not move as one, and its velocity nothing if it cannot fly.
inline std::vector<double> numbers_of(const physics::Cluster& cluster) {
  std::vector<double> numbers{double(cluster.first),       double(cluster.bodies),           double(cluster.is_held),
                              double(cluster.cannot_fly),  double(cluster.is_beside_static), double(cluster.island),
                              double(cluster.is_stirred),  double(cluster.is_restless),      double(cluster.is_borne),
                              double(cluster.moves_as_one)};
  if (cluster.cannot_fly == 0) numbers.insert(numbers.end(), cluster.island_velocity, cluster.island_velocity + 3);
  if (cluster.moves_as_one == 0) return numbers;
  const std::vector<double> motion = numbers_of(cluster.motion);
  numbers.insert(numbers.end(), motion.begin(), motion.end());
  if (cluster.bodies == 0) return numbers;
  numbers.insert(numbers.end(),
                 {cluster.mass, cluster.means.deformation, cluster.means.rigid, cluster.means.missed, cluster.means.due});
  return numbers;
}

inline std::vector<double> numbers_of(const physics::StepParts& parts) {
  return {parts.full, parts.last, double(parts.left), double(parts.steps), double(parts.parts)};
}

inline std::vector<double> numbers_of(const physics::QuietSteps& steps) {
  return {double(steps.end), double(steps.undone), double(steps.arrivals), double(steps.begun), double(steps.moving_shares)};
}

inline std::vector<double> numbers_of(const physics::QuietBody& body) {
  std::vector<double> numbers{double(body.bounds.room),         double(body.bounds.surprise),   double(body.frame_changes),
                              double(body.star.first_triangle), double(body.star.end_triangle), double(body.star.winding),
                              double(body.star.edge),           double(body.star.rounding)};
  const physics::QuietBounds& bounds = body.bounds;
  for (const float* bound : {bounds.lower, bounds.upper, bounds.least_velocity, bounds.most_velocity})
    numbers.insert(numbers.end(), bound, bound + 3);
  numbers.insert(numbers.end(), body.first_motion, body.first_motion + 12);
  numbers.insert(numbers.end(), body.reference, body.reference + 6);
  return numbers;
}

}  // namespace pliant
