// The passes of a simulation on one device, which tests run one by one.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collision/collider.hpp"
#include "device/array_list.hpp"
#include "dynamics/grip.hpp"
#include "simulation/step_passes.hpp"
#include "support/evolve.hpp"

namespace pliant {

inline StepTraits traits_of(const Method& method, bool vary_in_length) {
  return {.vary_in_length = vary_in_length,
          .have_forces_at_ends = has_forces_at_ends(find_integrator(method.integrator)),
          .damping_law = method.law};
}

/// Every device has the same trees then, if the scene leaves them to the device.
inline CollisionDescription with_alike_trees(CollisionDescription collision) {
  if (!collision.tree.refit) collision.tree.refit = TreeRefit::bottom_up;
  return collision;
}

/// A whole simulation's passes on one device, with its objects kept alive.
struct Bench {
  Bench(std::unique_ptr<Device> on, const ModelAndState& start, const Method& method, const CollisionDescription& collision)
      : device(std::move(on)),
        bodies(*device, start.model, start.state),
        stepper(bodies, start.model, find_integrator(method.integrator), method.law, method.time_step),
        collider(bodies, start.model, with_alike_trees(collision), traits_of(method, false), 256,
                 true),  // every device cuts its searches alike
        grip(bodies, start.model, 1) {
    grip.aim_at({0, 2, 0}, 1e-3);
    bodies.run_all_stages(false);  // every device runs stages one by one
  }

  /// The same, with steps that a tolerance governs.
  Bench(std::unique_ptr<Device> on, const ModelAndState& start, const Method& method, const CollisionDescription& collision,
        double tolerance)
      : device(std::move(on)),
        bodies(*device, start.model, start.state),
        stepper(bodies, start.model, find_integrator(method.integrator), method.law, method.time_step, Stages::of_estimates),
        collider(bodies, start.model, with_alike_trees(collision), traits_of(method, true), 256),
        grip(bodies, start.model, 1) {
    grip.aim_at({0, 2, 0}, 1e-3);
    bodies.run_all_stages(false);
    pacer.emplace(bodies, start.model, stepper, find_integrator(method.integrator), method.law,
                  PaceLimits{.tolerance = tolerance, .first_step = method.time_step, .largest_step = 2 * method.time_step});
    pacer->aim_at(4 * method.time_step);
  }

  /// Runs what has to come before the first step.
  void begin() {
    device->run(stepper.first_passes());
    bodies.prepare_search();
  }

  std::vector<Pass> step(std::uint32_t from_half) {
    return step_passes(bodies, stepper, collider, from_half, pacer ? &*pacer : nullptr);
  }

  /// The passes of a step, with a pull at its end.
  std::vector<Pass> pulled_step(std::uint32_t from_half) {
    std::vector<Pass> passes = step(from_half);
    std::ranges::copy(grip.passes(1 - from_half), std::back_inserter(passes));
    return passes;
  }

  template <class T>
  std::vector<T> read(BufferId buffer) {
    std::vector<T> values(device->size_of(buffer) / sizeof(T));
    device->read(buffer, 0, std::as_writable_bytes(std::span<T>(values)));
    return values;
  }

  std::unique_ptr<Device> device;
  DeviceBodies bodies;
  Stepper stepper;
  Collider collider;
  Grip grip;
  std::optional<Pacer> pacer;
};

/// Returns how many contacts by impulses are listed.
inline std::uint32_t contact_count(const Bench& bench) {
  return bench.bodies.arrays.get<physics::ContactList>("contact_list").download().front().contact_count;
}

}  // namespace pliant
