#include "bench/contact/witness.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/larger.hpp"

namespace pliant::bench {

// Sums with the digits that each addition loses. A plain sum of thousands of equal numbers can be off by 2e-14 of itself, as that
// of measure() is, whose bits histories have. Source: A. Neumaier, Rundungsfehleranalyse einiger Verfahren zur Summation
// endlicher Summen (1974).
glm::dvec3 momentum_of(const Model& model, const State& state) {
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  glm::dvec3 sum(0.0), lost(0.0);
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (model.body_of(i).is_rigid()) continue;
    const glm::dvec3 term = model.body_of(i).vertex_mass * velocities[i];
    for (int k = 0; k < 3; ++k) {
      const double before = sum[k];
      sum[k] += term[k];
      lost[k] += std::abs(before) >= std::abs(term[k]) ? (before - sum[k]) + term[k] : (term[k] - sum[k]) + before;
    }
  }
  return sum + lost;
}

double sum_of_momenta(const Model& model, const State& state) {
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  double sum = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i)
    if (!model.body_of(i).is_rigid()) sum += model.body_of(i).vertex_mass * glm::length(velocities[i]);
  return sum;
}

Witness::Witness(const ModelAndState& start)
    : start_(start),
      oracle_(start.model),
      first_(measure(start.model, start.state, glm::dvec3(0.0), pool_)),
      first_momentum_(momentum_of(start.model, start.state)),
      sum_of_momenta_(sum_of_momenta(start.model, start.state)),
      before_(start.state.world_positions(start.model)) {
  seen.most_deformed = start.state;
  const std::vector<glm::dvec3> velocities = start.state.world_velocities(start.model);
  for (std::size_t i = 0; i < velocities.size(); ++i)
    sum_of_angular_momenta_ += start.model.body_of(i).vertex_mass * glm::length(glm::cross(before_[i], velocities[i]));
}

void Witness::look_at_momentum(const State& state) {
  const double change = glm::length(momentum_of(start_.model, state) - first_momentum_);
  seen.momentum_change = larger(seen.momentum_change, change / sum_of_momenta_);
}

void Witness::look_at_places(const State& state) {
  look_at_momentum(state);
  const std::vector<glm::dvec3> after = state.world_positions(start_.model);
  for (int k = 1; k <= 8; ++k) seen.touching += oracle_.pairs_not_apart(between(before_, after, k / 8.0));
  before_ = after;
}

void Witness::look_at_place(const State& state) {
  look_at_momentum(state);
  seen.touching += oracle_.pairs_not_apart(state.world_positions(start_.model));
}

bool Witness::have_parted(const State& state) const { return oracle_.have_parted(state.world_positions(start_.model)); }

void Witness::look_at_motion(const State& state) {
  seen.inside += oracle_.vertices_inside_others(state.world_positions(start_.model));
  const Measurement now = measure(start_.model, state, glm::dvec3(0.0), pool_);
  look_at_momentum(state);
  seen.angular_momentum_change = glm::length(now.angular_momentum - first_.angular_momentum) / sum_of_angular_momenta_;
  seen.last_energy = (now.energy() - first_.energy()) / first_.kinetic;
  seen.most_energy = larger(seen.most_energy, seen.last_energy);
  if (now.elastic <= most_elastic_) return;
  most_elastic_ = now.elastic;
  seen.most_deformed = state;
}

void watch(Simulation& simulation, Witness& witness, const Watch& how) {
  StepReport& report = witness.seen.report;
  for (std::uint64_t part = 1;
       report.steps < how.steps && part <= how.most_parts && !report.breakdown && !how.stop.stop_requested(); ++part) {
    simulation.advance_part();
    report = simulation.report();
    const State state = simulation.state();
    witness.look_at_places(state);
    if (part % how.stride == 0 || report.steps == how.steps || part == how.most_parts) witness.look_at_motion(state);
  }
}

Seen watch(Simulation& simulation, const ModelAndState& start, const Watch& how) {
  Witness witness(start);
  watch(simulation, witness, how);
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
