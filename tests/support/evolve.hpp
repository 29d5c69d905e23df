// Small bodies, and a run of a few steps on a device: what the tests of dynamics need.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/larger.hpp"
#include "device/device.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "model/model.hpp"
#include "simulation/simulation.hpp"

namespace pliant {

/// A body of the given mesh with k = m = c = 1, at the origin, at rest.
inline BodySetup body_of_mesh(TriangleMesh mesh) {
  BodySetup setup;
  setup.mesh = std::move(mesh);
  setup.description.name = "body";
  setup.description.stiffness = 1;
  setup.description.vertex_mass = 1;
  setup.description.damping = 1;
  return setup;
}

inline BodySetup sphere(int level) { return body_of_mesh(generate_mesh("icosphere:" + std::to_string(level))); }

/// Two vertices, 1 m apart along x, joined by one spring.
inline BodySetup two_vertices() { return body_of_mesh({{{-0.5, 0, 0}, {0.5, 0, 0}}, {}}); }

inline ModelAndState built(const BodySetup& setup, const glm::dvec3& gravity = glm::dvec3(0.0)) {
  return build_model({&setup, 1}, gravity);
}

struct Method {
  std::string_view integrator;
  double time_step;  // [s]
  DampingLaw law = DampingLaw::none;
};

inline TimePlan plan_of(const Method& method) {
  return {.integrator = &find_integrator(method.integrator), .time_step = method.time_step, .damping_law = method.law};
}

/// Steps that a tolerance governs.
struct Adaptive {
  std::string_view integrator = "dop853";
  double tolerance = 1e-6;
  std::optional<double> first_step = {};  // [s], a tenth of the bound unless given
  DampingLaw law = DampingLaw::none;
};

inline TimePlan plan_of(const Adaptive& adaptive, const Model& model) {
  TimePlan plan = plan_of(Method{adaptive.integrator, 0, adaptive.law});
  plan.tolerance = adaptive.tolerance;
  plan.step_bound = std::numeric_limits<double>::infinity();
  for (const ModelBody& body : model.bodies)
    plan.step_bound = std::min(plan.step_bound, step_bound(*plan.integrator, body, adaptive.law));
  plan.time_step = adaptive.first_step.value_or(first_step_fraction * plan.step_bound);
  if (adaptive.first_step) plan.step_bound = std::max(plan.step_bound, *adaptive.first_step);
  return plan;
}

/// The state after `steps` steps, without contacts.
inline State evolve(Device& device, const ModelAndState& start, const Method& method, std::uint64_t steps) {
  CollisionDescription apart;
  apart.response = Named{"none"};
  Simulation simulation(device, start.model, start.state, plan_of(method), apart);
  simulation.advance(steps);
  return simulation.state();
}

/// The stiffest mode's angular frequency [1/s].
inline double stiffest_omega(const Model& model) { return stiffest_frequency(model.bodies.front()); }

/// Root of the sum over vertices of |a - b|^2.
inline double distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum);
}

/// The CPU at both precisions, and the GPU if OpenGL is present.
struct TestDevice {
  std::string name;
  std::unique_ptr<Device> device;
  double rounding;  // of the forces
};
std::vector<TestDevice> all_devices();

}  // namespace pliant
