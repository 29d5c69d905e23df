// What tests of contact by impulses share: soft bodies of 1 kg, and energy and momentum along a run.
#pragma once
#include <catch2/catch.hpp>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>

#include "bench/contact/witness.hpp"
#include "simulation/measure.hpp"
#include "support/evolve.hpp"

namespace pliant {

inline const CollisionDescription by_impulses = {.response = {"impulse"}, .elasticity = 0.5};

// Half of the smallest one that scenes can have. With those hardly any motion is cut short.
constexpr double small_gap = 0.005;

constexpr double total_stiffness = 1000, omega = 31.6227766;  // [N/m], [1/s] of a body of 1 kg

inline BodySetup soft(TriangleMesh mesh, const char* name) {
  BodySetup setup = body_of_mesh(std::move(mesh));
  setup.description.name = name;
  setup.description.total_mass = 1;
  setup.description.total_stiffness = total_stiffness;
  setup.description.damping = 0;
  return setup;
}

// Gives the first body velocities that its rest positions tell [m] -> [m/s].
template <class Velocity>
void set_velocities(ModelAndState& start, const Velocity& velocity) {
  const ModelBody& body = start.model.bodies.front();
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) {
    const glm::dvec3 w = velocity(start.model.rest_position(i));
    for (int k = 0; k < 3; ++k) start.state.motion[physics::velocity_of(i) + static_cast<std::size_t>(k)] = w[k];
  }
}

// Measures a run in parts of steps.
struct Energies {
  double first = 0, most = 0, last = 0;  // [J]
  glm::dvec3 momentum{0.0};              // the last one, less what gravity and what does not move have given [Ns]
  glm::dvec3 turning_change{0.0};        // of the angular momentum about the centre of all masses [kg m^2/s]
  StepReport report;
};

// Of the first bodies, but for static ones, about their common centre [kg m^2/s].
inline glm::dvec3 angular_momentum_about_centre(const Model& model, const State& state, std::uint32_t bodies = UINT32_MAX) {
  const std::vector<glm::dvec3> places = state.world_positions(model), velocities = state.world_velocities(model);
  glm::dvec3 centre(0.0), momentum(0.0), turning(0.0);
  double mass = 0;
  for (std::uint32_t i = 0; i < places.size() && model.body_index(i) < bodies; ++i) {
    if (model.body_of(i).is_rigid()) continue;
    const double m = model.body_of(i).vertex_mass;
    mass += m;
    centre += m * places[i];
    momentum += m * velocities[i];
    turning += m * glm::cross(places[i], velocities[i]);
  }
  return turning - glm::cross(centre / mass, momentum);
}

inline Energies energies_of(Simulation& simulation, const ModelAndState& start, const glm::dvec3& gravity, double duration) {
  ThreadPool pool(1);
  const Measurement before = measure(start.model, start.state, gravity, pool);
  Energies seen;
  seen.first = seen.most = before.energy();
  Measurement now = before;
  while (simulation.report().time < duration) {
    simulation.advance(2);
    now = measure(start.model, simulation.state(), gravity, pool);
    seen.most = larger(seen.most, now.energy());
  }
  seen.report = simulation.report();
  seen.last = now.energy();
  double mass = 0;
  for (const ModelBody& body : start.model.bodies)
    if (!body.is_rigid()) mass += body.vertex_mass * body.vertex_count;
  seen.momentum = now.momentum - before.momentum - seen.report.time * mass * gravity - seen.report.response.outside_impulse;
  seen.turning_change =
      angular_momentum_about_centre(start.model, simulation.state()) - angular_momentum_about_centre(start.model, start.state);
  return seen;
}

// How the energy changes in a run without gravity, over the kinetic energy at the start.
struct EnergySwing {
  double least = 0;      // less than at the start, so below 0
  double most_rise = 0;  // from the least so far. Infinite if the energy is not a number
};

inline EnergySwing energy_swing_of(Simulation& simulation, const ModelAndState& start, int looks, int parts_between) {
  bench::Witness witness(start);
  EnergySwing swing;
  for (int look = 0; look < looks; ++look) {
    for (int part = 0; part < parts_between; ++part) simulation.advance_part();
    witness.look_at_motion(simulation.state());
    const double now = witness.seen.last_energy;
    swing.least = std::min(swing.least, now);
    swing.most_rise = larger(swing.most_rise, now - swing.least);
  }
  return swing;
}

// What a run had done when it was saved, and by its end.
struct SavedRun {
  StepReport saved, last;
};

// Checks that a run ends in the same bits on one thread, on three, and when it was saved after `saved_at` steps and goes on in
// another simulation.
inline SavedRun check_same_bits(const ModelAndState& start, const Method& method, const CollisionDescription& collision,
                                std::uint64_t saved_at, std::uint64_t steps) {
  const auto simulation_on = [&](Device& device) {
    return std::make_unique<Simulation>(device, start.model, start.state, plan_of(method), collision);
  };
  const auto one = make_cpu_device(1, 32), three = make_cpu_device(3, 32);
  const auto whole = simulation_on(*one), shared_out = simulation_on(*three), resumed = simulation_on(*one);
  whole->advance(saved_at);
  const StepReport saved = whole->report();
  resumed->restore(whole->save());
  for (const auto& simulation : {whole.get(), resumed.get()}) simulation->advance(steps - saved_at);
  shared_out->advance(steps);
  CHECK(shared_out->state().motion == whole->state().motion);
  CHECK(resumed->state().motion == whole->state().motion);
  return {saved, whole->report()};
}

}  // namespace pliant
