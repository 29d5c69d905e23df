#include "bench/contact/encounter.hpp"

#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "core/larger.hpp"

namespace pliant::bench {
namespace {

constexpr std::uint64_t at_once = 16;           // parts of steps between looks that are not close
constexpr std::uint64_t between_motions = 512;  // parts between looks at motions then

void advance_some_parts(Simulation& simulation) {
  for (std::uint64_t k = 0; k < at_once; ++k) simulation.advance_part();
}

void go_to_the_first_impulse(Simulation& simulation, std::uint64_t most_parts, const std::stop_token& stop) {
  std::string earlier, saved = simulation.save();
  for (std::uint64_t part = 0; part < most_parts && !stop.stop_requested(); part += at_once) {
    earlier = std::exchange(saved, simulation.save());
    advance_some_parts(simulation);
    const StepReport report = simulation.report();
    if (report.contact_steps == 0 && !report.breakdown) continue;
    simulation.restore(earlier);
    return;
  }
}

// Returns what was done since an earlier report, of what this study counts.
StepReport since(const StepReport& earlier, StepReport report) {
  report.steps -= earlier.steps;
  report.substeps -= earlier.substeps;
  report.time -= earlier.time;
  report.reverted_vertices -= earlier.reverted_vertices;
  report.held_parts -= earlier.held_parts;
  return report;
}

bool part_at_last(Simulation& simulation, Witness& witness, std::uint64_t most_parts, const std::stop_token& stop) {
  for (std::uint64_t part = 0;; part += at_once) {
    const State state = simulation.state();
    const bool parted = witness.have_parted(state);
    const bool ends = parted || part >= most_parts || stop.stop_requested() || simulation.report().breakdown;
    witness.look_at_place(state);
    if (ends || part % between_motions == 0) witness.look_at_motion(state);
    if (ends) return parted;
    advance_some_parts(simulation);
  }
}

}  // namespace

SeenEncounter watch_encounter(Simulation& simulation, const Model& model, const Patience& patience, const std::stop_token& stop) {
  go_to_the_first_impulse(simulation, patience.to_meet, stop);
  const ModelAndState start{model, simulation.state()};
  const StepReport unwatched = simulation.report();
  Witness witness(start);
  watch(simulation, witness, {.most_parts = patience.closely, .stride = patience.stride, .stop = stop});
  const StepReport closely = since(unwatched, simulation.report());
  const bool parted = part_at_last(simulation, witness, patience.to_part, stop);
  witness.seen.report = since(unwatched, simulation.report());
  return {.seen = witness.seen, .close_steps = closely.steps, .close_parts = closely.steps + closely.substeps, .parted = parted};
}

double most_change_of_momentum(Simulation& simulation, const Model& model, std::uint64_t steps, const std::stop_token& stop) {
  const glm::dvec3 first = momentum_of(model, simulation.state());
  double most = 0;
  for (std::uint64_t step = 0; step < steps && !stop.stop_requested(); ++step) {
    simulation.advance(1);
    most = larger(most, glm::length(momentum_of(model, simulation.state()) - first));
  }
  return most;
}

}  // namespace pliant::bench
