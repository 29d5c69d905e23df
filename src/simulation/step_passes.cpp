#include "simulation/step_passes.hpp"

#include "physics/layout.glsl"

namespace pliant {
namespace {

class List {
 public:
  void add(Pass pass) { passes_.push_back(std::move(pass)); }
  void add(std::vector<Pass> passes) {
    for (Pass& pass : passes) add(std::move(pass));
  }
  std::vector<Pass> take() { return std::move(passes_); }

 private:
  std::vector<Pass> passes_;
};

// What a response may do itself.
std::vector<Pass> restating_passes(const Stepper& stepper, const Collider& collider, std::uint32_t from_half) {
  if (collider.response_row().follows_frames) return {};
  return {stepper.restating_pass(from_half)};
}

// Frames follow their bodies while search passes run that do not use the changed arrays.
void add_search_while_following(List& step, const Stepper& stepper, const Collider& collider, std::uint32_t from_half) {
  const std::uint32_t half = physics::other_half(from_half);
  step.add(collider.pairing_passes(half));
  step.add(collider.refitting_passes(half));
  step.add(beside_next(stepper.following_pass(from_half)));
  step.add(collider.finding_passes());
  for (const Pass& pass : restating_passes(stepper, collider, from_half)) step.add(beside_next(pass));
  step.add(collider.testing_passes(half));
}

void add_following(List& step, const Stepper& stepper, const Collider& collider, std::uint32_t from_half) {
  step.add(stepper.following_pass(from_half));
  step.add(restating_passes(stepper, collider, from_half));
}

}  // namespace

std::vector<Pass> step_passes(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider,
                              std::uint32_t from_half, const Pacer* pacer) {
  const std::uint32_t half = physics::other_half(from_half);
  const Response* const response = collider.response();
  const bool searches = response != nullptr && collider.response_row().answers_touching;
  List step;
  // length
  if (pacer != nullptr) step.add(pacer->beginning_pass());
  // kick
  if (response != nullptr) step.add(response->before_step(from_half));
  // integrate
  step.add(stepper.passes(from_half));
  // find contacts and let frames follow; with a tolerance frames follow after the judging, because it may undo the step
  if (pacer != nullptr) {
    step.add(pacer->estimating_pass());
    if (searches) step.add(collider.search_passes(half));
    if (searches) step.add(pacer->contact_pass(from_half));
    step.add(pacer->judging_passes(from_half));
    if (response != nullptr && !searches) step.add(response->after_step(from_half));
    add_following(step, stepper, collider, from_half);
  } else if (searches && collider.uses_trees()) {
    add_search_while_following(step, stepper, collider, from_half);
  } else {
    if (searches) step.add(collider.search_passes(half));
    if (response != nullptr && !searches) step.add(response->after_step(from_half));
    add_following(step, stepper, collider, from_half);
  }
  // answer contacts
  if (searches) step.add(response->after_step(from_half));
  // report; the next step's first pass may run beside it because it uses nothing that this pass changes
  step.add(beside_next(make_pass(bodies.arrays, "finish_step", {}, physics::counter_count)));
  return step.take();
}

}  // namespace pliant
