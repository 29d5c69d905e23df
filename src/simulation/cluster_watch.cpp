#include "simulation/cluster_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "dynamics/forces/force.hpp"
#include "physics/layout.glsl"

namespace pliant {
namespace {

constexpr std::uint32_t forces_between_checks = 64;
constexpr std::uint32_t most_changes = 8;  // of how a body's springs are summed: each changes its energy
constexpr double most_strained = 2;        // error over the tolerance up to which lists still beat direct sums

// Sums of fp32 or fp64 are as inexact as that, over the sum of what they add up.
double rounding_of(int precision) { return precision == 64 ? 0x1p-47 : 0x1p-18; }

std::vector<glm::dvec3> displacements_of(const ModelBody& body, const State& state) {
  std::vector<glm::dvec3> displacements;
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
    displacements.push_back(state.displacement(i));
  return displacements;
}

bool sums_springs(const physics::Status& status) {
  return status.activity == physics::moving && status.deformed != 0 && !physics::is_still(status);
}

}  // namespace

ClusterWatch::ClusterWatch(DeviceBodies& bodies, const Model& model, Stepper& stepper, std::uint32_t forces_of_a_step)
    : bodies_(bodies),
      model_(model),
      stepper_(stepper),
      interval_(std::max(forces_between_checks / forces_of_a_step, 1u)),
      changed_(model.bodies.size()),
      changes_(model.bodies.size()),
      is_strained_(model.bodies.size()),
      counted_(model.bodies.size()) {}

bool ClusterWatch::check(std::uint64_t steps, const std::function<State()>& state) {
  next_check_ = (steps / interval_ + 1) * interval_;
  const auto before = changed_;
  std::vector<std::optional<double>> errors = measure();
  for (std::size_t b = 0; b < errors.size(); ++b) {
    if (!errors[b]) continue;
    ++report_.checks;
    if (!(*errors[b] <= limit_of(b))) {
      improve(b, state());
      errors[b] = measure()[b];
    }
    if (errors[b]) report_.largest_error = std::max(report_.largest_error, *errors[b]);
  }
  return changed_ != before;
}

double ClusterWatch::limit_of(std::size_t body) const {
  return (is_strained_[body] != 0 ? most_strained : 1) * force_tolerance_of(model_.bodies[body]);
}

std::vector<std::optional<double>> ClusterWatch::measure() {
  Device& device = bodies_.arrays.device();
  std::vector<std::optional<double>> relative(model_.bodies.size());
  const ClusterForces* const forces = stepper_.cluster_forces();
  if (forces == nullptr) return relative;
  device.run(forces->measuring_passes(physics::start_slot));
  const std::vector<physics::Status> statuses = bodies_.statuses.download();
  const std::vector<ClusterErrors> errors = forces->errors();
  for (std::size_t b = 0; b < relative.size(); ++b) {
    if (forces->springs_of(b) == 0 || !sums_springs(statuses[b])) continue;
    const bool is_rounding = errors[b].error <= rounding_of(device.precision()) * errors[b].size;
    relative[b] = is_rounding ? 0 : errors[b].relative();
  }
  return relative;
}

void ClusterWatch::improve(std::size_t body, const State& state) {
  const double tolerance = force_tolerance_of(model_.bodies[body]), least = accuracy_of(tolerance) / 10;
  const double accuracy = changed_[body] ? changed_[body]->accuracy : accuracy_of(tolerance);
  const std::vector<glm::dvec3> displacements = displacements_of(model_.bodies[body], state);
  double error = INFINITY;
  for (const double next : {accuracy, least}) {
    if (changes_[body] >= most_changes || (next == accuracy && std::isfinite(error))) break;
    try {
      change(body, state, std::make_shared<const ChangedSums>(ChangedSums{false, next, displacements}));
    } catch (const Error&) {  // so many vertices have come together that lists would be too long
      break;
    }
    ++report_.lists_made;
    error = measure()[body].value_or(0);
    if (error <= tolerance) return;
  }
  is_strained_[body] = 1;
  if (error <= limit_of(body)) return;
  change(body, state, std::make_shared<const ChangedSums>(ChangedSums{.are_direct = true, .accuracy = 0, .displacements = {}}));
  report_.direct.push_back(static_cast<std::uint32_t>(body));
}

void ClusterWatch::change(std::size_t body, const State& state, std::shared_ptr<const ChangedSums> sums) {
  auto changed = changed_;
  changed[body] = std::move(sums);
  const double before = energy_of(state);
  const std::uint64_t evaluations = bodies_.tallies.download()[body].force_evaluations;
  const Counted counted{evaluations, interactions(body, evaluations)};
  stepper_.change_sums(model_, changed);
  changed_ = std::move(changed);
  counted_[body] = counted;
  ++changes_[body];
  report_.energy_change += std::abs(energy_of(state) - before);
  std::vector<physics::Status> statuses = bodies_.statuses.download();
  statuses[body].force_stale = 1;
  bodies_.statuses.upload(statuses);
}

double ClusterWatch::energy_of(State state) {
  state.changed_sums = changed_;
  ThreadPool pool(0);
  const std::function<bool()> nobody_stops;
  return forces().front().energy({model_, state, pool, nobody_stops, energies_});
}

std::uint64_t ClusterWatch::interactions(std::size_t body, std::uint64_t evaluations) const {
  const std::uint64_t vertices = model_.bodies[body].vertex_count;
  const std::uint64_t springs = stepper_.cluster_forces() != nullptr ? stepper_.cluster_forces()->springs_of(body) : 0;
  const std::uint64_t each = springs > 0 ? 2 * springs : vertices * (vertices - 1);
  return counted_[body].interactions + (evaluations - counted_[body].evaluations) * each;
}

void ClusterWatch::use(const std::vector<std::shared_ptr<const ChangedSums>>& changed) {
  if (changed == changed_) return;
  stepper_.change_sums(model_, changed);
  changed_ = changed;
}

void ClusterWatch::save(ByteWriter& to) const {
  to(next_check_, report_.checks, report_.largest_error, report_.lists_made, report_.energy_change, report_.direct, changes_,
     is_strained_, counted_);
  for (const std::shared_ptr<const ChangedSums>& sums : changed_) {
    to(sums != nullptr);
    if (sums) to(sums->are_direct, sums->accuracy, sums->displacements);
  }
}

void ClusterWatch::restore(ByteReader& from) {
  from(next_check_, report_.checks, report_.largest_error, report_.lists_made, report_.energy_change, report_.direct, changes_,
       is_strained_, counted_);
  std::vector<std::shared_ptr<const ChangedSums>> changed(model_.bodies.size());
  for (std::size_t b = 0; b < changed.size(); ++b) {
    if (!from.get<bool>()) continue;
    ChangedSums sums;
    from(sums.are_direct, sums.accuracy, sums.displacements);
    const bool is_known = changed_[b] && changed_[b]->are_direct == sums.are_direct && changed_[b]->accuracy == sums.accuracy &&
                          changed_[b]->displacements == sums.displacements;
    changed[b] = is_known ? changed_[b] : std::make_shared<const ChangedSums>(std::move(sums));
  }
  use(changed);
}

}  // namespace pliant
