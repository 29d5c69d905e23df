#include "collision/broad_phase/body_pairs.hpp"

#include <algorithm>
#include <bit>

#include "core/expect.hpp"

namespace pliant {
namespace {

// Balls of one size in a grid, with their boxes a little larger than they are, have 13 near pairs each.
constexpr std::uint32_t near_pairs_of_body = 24, fewest_near_pairs = 1u << 19;
// With fewer bodies comparing each with each takes less time (docs/benchmarks). A GPU has passes to start for a grid.
std::uint32_t fewest_in_a_grid(const Device& device) { return device.info().kind == DeviceKind::gpu ? 2048 : 32; }

// Of bodies with triangles, one of which moves.
std::uint32_t pairs_that_may_touch(const Model& model) {
  std::uint32_t moving = 0, fixed = 0;
  for (const ModelBody& body : model.bodies)
    if (body.triangle_count > 0) ++(body.is_rigid() ? fixed : moving);
  return moving * (moving - std::min(moving, 1u)) / 2 + moving * fixed;
}

// A body that meets itself is a pair of its own.
std::uint32_t room_for_pairs(const Model& model) {
  const auto bodies = static_cast<std::uint32_t>(model.bodies.size());
  const auto own = static_cast<std::uint32_t>(std::ranges::count_if(model.bodies, &ModelBody::self_contact));
  const std::uint32_t all = bodies * (bodies - std::min(bodies, 1u)) / 2 + own;
  return std::clamp(all, 1u, std::max(fewest_near_pairs, near_pairs_of_body * bodies));
}

// Twice as many lists as bodies, at least, or none without a grid.
std::uint32_t lists_for(BroadPhase broad_phase, const DeviceBodies& bodies) {
  const bool is_grid = broad_phase == BroadPhase::automatic ? bodies.body_count >= fewest_in_a_grid(bodies.arrays.device())
                                                            : broad_phase == BroadPhase::grid;
  return is_grid ? std::bit_ceil(2 * bodies.body_count) : 0;
}

}  // namespace

BodyPairs::BodyPairs(DeviceBodies& bodies, const Model& model, BroadPhase broad_phase)
    : bodies_(bodies),
      pair_count_(pairs_that_may_touch(model)),
      most_pairs_(room_for_pairs(model)),
      grid_lists_(lists_for(broad_phase, bodies)),
      threads_of_body_(bodies.arrays.device().info().kind == DeviceKind::gpu ? 27 : 1) {
  PLIANT_EXPECT(bodies.body_count <= 65535);
  Arrays& arrays = bodies.arrays;
  arrays.make<glm::uvec4>("near_pair", most_pairs_);
  arrays.make<std::uint32_t>("grid_list", std::max(grid_lists_, 1u));
  arrays.make<physics::GridEntry>("grid_entry", grid_lists_ > 0 ? bodies.body_count : 1);
  arrays.make<std::uint32_t>("grid_level", physics::level_words);
  arrays.set_parameter("grid_lists", grid_lists_);
  arrays.set_parameter("threads_of_body", threads_of_body_);
}

Pass BodyPairs::bounding_pass(std::uint32_t half) const {
  return make_pass(bodies_.arrays, "bound_bodies", {{"first_position", bodies_.first_of_half(half)}}, bodies_.vertex_count);
}

std::vector<Pass> BodyPairs::pairing_passes() const {
  return passes_over_pairs(
      "enter_boxes", make_pass(bodies_.arrays, "pair_bodies", {{"pair_count", pair_count_}, {"near_pair_capacity", most_pairs_}},
                               visiting_threads()));
}

std::vector<Pass> BodyPairs::limiting_passes() const {
  return passes_over_pairs("enter_reaches", make_pass(bodies_.arrays, "limit_step", {}, visiting_threads()));
}

std::vector<Pass> BodyPairs::passes_over_pairs(std::string_view entering, Pass visiting) const {
  if (grid_lists_ == 0) return {std::move(visiting)};
  const Arrays& arrays = bodies_.arrays;
  return {make_pass(arrays, entering, {}, bodies_.body_count), std::move(visiting),
          beside_next(make_pass(arrays, "leave_grid", {}, bodies_.body_count))};
}

std::uint32_t BodyPairs::visiting_threads() const {
  return bodies_.body_count * (grid_lists_ == 0 ? bodies_.body_count : threads_of_body_);
}

}  // namespace pliant
