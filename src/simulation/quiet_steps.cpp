#include "simulation/quiet_steps.hpp"

#include <algorithm>
#include <iterator>
#include <span>

namespace pliant {
namespace {

constexpr std::uint32_t any_number = ~0u;

bool may_meet(const Collider& collider) { return collider.response() != nullptr && collider.searches(); }

bool have_one_share_each(const DeviceBodies& bodies) { return bodies.force_groups[0].has_whole_bodies; }

// If bodies have several shares, each work group has one at most. And of bodies that may meet each is compared with all.
std::uint32_t most_moving_shares(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider) {
  return std::min(have_one_share_each(bodies) ? any_number : stepper.quiet_group_count(),
                  may_meet(collider) ? physics::most_quiet_shares : any_number);
}

// A work group that may have to serve several shares makes fewer steps, so that a dispatch takes no longer.
std::uint32_t most_of_groups_that_wait(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider) {
  const std::uint32_t shares =
      std::min(static_cast<std::uint32_t>(bodies.shares().size()), most_moving_shares(bodies, stepper, collider));
  const std::uint32_t shares_of_a_group = (shares - 1) / stepper.quiet_group_count() + 1;
  return std::max(physics::most_quiet_steps / shares_of_a_group, physics::fewest_quiet_steps);
}

// Where groups do not wait for each other, a driver in software runs the only one. It stops long loops (docs/step.md, Limits).
std::uint32_t most_at_once(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider) {
  if (bodies.arrays.device().shares_at_once() > 0) return most_of_groups_that_wait(bodies, stepper, collider);
  constexpr std::uint64_t most_turns = 16384, turns_beside_a_sum = 32;
  std::uint64_t turns = 0;  // of one thread in a step
  for (const physics::Share& share : bodies.shares().download())
    turns += stepper.stage_count() * (share.body.vertex_count + turns_beside_a_sum);
  return static_cast<std::uint32_t>(turns == 0 ? 0 : std::min(most_turns / turns, std::uint64_t{4}));
}

// Whether contacts are found where steps end, if at all.
bool looks_at_ends(const Collider& collider) {
  return collider.response() == nullptr || (collider.response_row().answers_touching && collider.uses_trees());
}

ForceSpan span_of(const Collider& collider) {
  return looks_at_ends(collider) ? ForceSpan::quiet_steps : ForceSpan::quiet_steps_of_impulses;
}

// Those that set bounds, after shares of moving bodies have been listed. There are none if the response knows no quiet steps.
std::vector<Pass> bounding_passes(std::uint32_t half, const DeviceBodies& bodies, const Collider& collider) {
  if (!looks_at_ends(collider)) return collider.response()->before_quiet_steps(half);
  std::vector<Pass> passes;
  if (may_meet(collider)) passes.push_back(collider.bounding_pass(half));
  passes.push_back(make_pass(bodies.arrays, "give_room", {{"from_half", half}, {"searches", may_meet(collider) ? 1u : 0u}},
                             bodies.body_count));
  return passes;
}

std::vector<Pass> passes_from(std::uint32_t half, const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider) {
  const std::vector<Pass> bounding = bounding_passes(half, bodies, collider);
  if (bounding.empty()) return {};
  std::vector<Pass> passes = {
      beside_next(make_pass(bodies.arrays, "list_moving_shares", {{"most_shares", most_moving_shares(bodies, stepper, collider)}},
                            static_cast<std::uint32_t>(bodies.shares().size())))};
  std::ranges::copy(bounding, std::back_inserter(passes));
  passes.push_back(stepper.quiet_pass(half, span_of(collider)));
  const std::uint32_t pairs = collider.response() != nullptr ? collider.pair_count() : 0;
  passes.push_back(make_pass(bodies.arrays, "end_quiet_steps", {{"pair_count", pairs}}, bodies.body_count));
  if (!looks_at_ends(collider)) std::ranges::move(collider.response()->after_quiet_steps(), std::back_inserter(passes));
  return passes;
}

}  // namespace

QuietSteps::QuietSteps(DeviceBodies& bodies, const Stepper& stepper, const Collider& collider) {
  if (!stepper.makes_quiet_steps()) return;
  most_at_once_ = most_at_once(bodies, stepper, collider);
  if (most_at_once_ < physics::fewest_quiet_steps) return;
  steps_ = &bodies.arrays.make<physics::QuietSteps>("quiet_steps", 1);
  bodies.arrays.make<physics::QuietBody>("quiet_body", std::max(bodies.body_count, stepper.quiet_group_count()));
  bodies.arrays.make<double>("kept_before", stepper.keeps_force() ? std::size_t{3} * bodies.vertex_count : 1);
  for (std::uint32_t half = 0; half < 2; ++half) passes_[half] = passes_from(half, bodies, stepper, collider);
  if (!are_known()) return;
  aim_at(0);
  const Pass pass = stepper.quiet_pass(0, span_of(collider));
  bodies.arrays.device().run({&pass, 1});  // makes no step, but NVIDIA's driver ends building with the first run
}

void QuietSteps::aim_at(std::uint64_t most) const {
  const physics::QuietSteps asked{.end = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, most_at_once_)),
                                  .undone = ~0u,
                                  .arrivals = 0,
                                  .begun = 0,
                                  .moving_shares = 0};
  steps_->upload(std::span(&asked, 1));
}

std::uint32_t QuietSteps::take_made() {
  const physics::QuietSteps made = steps_->download().front();
  if (made.begun == 0 && (made.arrivals & physics::waited_in_vain) != 0) passes_ = {};
  return physics::steps_made(made);
}

}  // namespace pliant
