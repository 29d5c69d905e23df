#include "bench/contact/witness.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace pliant::bench {

Witness::Witness(const ModelAndState& start)
    : start_(start),
      oracle_(start.model),
      first_(measure(start.model, start.state, glm::dvec3(0.0), pool_)),
      before_(start.state.world_positions(start.model)) {
  const std::vector<glm::dvec3> velocities = start.state.world_velocities(start.model);
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const glm::dvec3 momentum = start.model.body_of(i).vertex_mass * velocities[i];
    sum_of_momenta_ += glm::length(momentum);
    sum_of_angular_momenta_ += glm::length(glm::cross(before_[i], momentum));
  }
}

void Witness::look_at_places(const State& state) {
  const std::vector<glm::dvec3> after = state.world_positions(start_.model);
  for (int k = 1; k <= 8; ++k) seen.touching += oracle_.pairs_not_apart(between(before_, after, k / 8.0));
  before_ = after;
}

void Witness::look_at_motion(const State& state) {
  seen.inside += oracle_.vertices_inside_others(state.world_positions(start_.model));
  const Measurement now = measure(start_.model, state, glm::dvec3(0.0), pool_);
  seen.momentum_change = std::max(seen.momentum_change, glm::length(now.momentum - first_.momentum) / sum_of_momenta_);
  seen.angular_momentum_change = glm::length(now.angular_momentum - first_.angular_momentum) / sum_of_angular_momenta_;
  seen.last_energy = (now.energy() - first_.energy()) / first_.kinetic;
  seen.most_energy = std::max(seen.most_energy, seen.last_energy);
}

Seen watch(Simulation& simulation, const ModelAndState& start, const Watch& how) {
  Witness witness(start);
  StepReport& report = witness.seen.report;
  for (std::uint64_t part = 1;
       report.steps < how.steps && part <= how.most_parts && !report.breakdown && !how.stop.stop_requested(); ++part) {
    simulation.advance_part();
    report = simulation.report();
    const State state = simulation.state();
    witness.look_at_places(state);
    if (part % how.stride == 0 || report.steps == how.steps || part == how.most_parts) witness.look_at_motion(state);
  }
  return witness.seen;
}

Seen watch_for(Simulation& simulation, const ModelAndState& start, double duration) {
  Witness witness(start);
  StepReport& report = witness.seen.report;
  while (report.time < duration && !report.breakdown) {
    report = simulation.advance_toward(duration, 1);
    const State state = simulation.state();
    witness.look_at_places(state);
    witness.look_at_motion(state);
  }
  return witness.seen;
}

}  // namespace pliant::bench
