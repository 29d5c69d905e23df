// A step of a method with stages is one dispatch per stage, and that of a splitting is one dispatch per force. Both can be one
// dispatch in all.
#include "dynamics/stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "physics/damping.glsl"
#include "physics/layout.glsl"
#include "physics/quiet.glsl"

namespace pliant {
namespace {

static_assert(static_cast<std::uint32_t>(DampingLaw::none) == physics::damping_none);
static_assert(static_cast<std::uint32_t>(DampingLaw::constant) == physics::damping_constant);
static_assert(static_cast<std::uint32_t>(DampingLaw::adaptive) == physics::damping_adaptive);

// Returns the stage's weight in the final velocity, and its reciprocal (0 if the weight is 0). The kernel uses the reciprocal to
// cancel earlier rounding.
glm::dvec2 weight_at_end(const NystromTableau& tableau, std::size_t stage) {
  const double weight = tableau.velocity[static_cast<std::size_t>(tableau.stages * tableau.stages) + stage];
  return {weight, weight == 0 ? 0 : 1 / weight};
}

// Returns the rows that runge_kutta_stage.glsl reads (see its next_row()). An error estimate weighs stages in another way than
// the step's end, so what cancels in one does not cancel in the other.
std::vector<glm::dvec2> stage_rows(const NystromTableau& tableau, bool cancels_rounding) {
  std::vector<glm::dvec2> rows;
  const auto stages = static_cast<std::size_t>(tableau.stages);
  for (std::size_t next = 1; next <= stages; ++next) {
    const auto weights = [&](std::size_t j) {
      return glm::dvec2(tableau.position[next * stages + j], tableau.velocity[next * stages + j]);
    };
    rows.emplace_back(tableau.c[next], tableau.keep[next]);
    rows.push_back(weights(next - 1));
    rows.push_back(next < stages && cancels_rounding ? weight_at_end(tableau, next) : glm::dvec2(0));
    for (std::size_t j = 0; j + 1 < next; ++j) rows.push_back(weights(j));
    rows.resize(next * physics::tableau_row_size(static_cast<std::uint32_t>(stages)));
  }
  return rows;
}

double seconds(long double fraction, double time_step) {
  return static_cast<double>(fraction * static_cast<long double>(time_step));
}

// Returns the rows that splitting_stage.glsl reads, for steps of the given length [s].
std::vector<glm::dvec2> splitting_rows(const Splitting& method, double time_step) {
  std::vector<glm::dvec2> rows;
  long double elapsed = method.drift[0];
  for (std::size_t stage = 0; stage < method.drift.size(); ++stage) {
    const long double drift = stage + 1 < method.drift.size() ? method.drift[stage + 1] : 0;
    elapsed += drift;
    rows.emplace_back(seconds(method.kick[stage + 1], time_step), seconds(drift, time_step));
    rows.emplace_back(seconds(elapsed, time_step), 0);
  }
  return rows;
}

// Internal damping is constant damping with forces beside it. Where no body is damped, no law is asked.
std::uint32_t law_of_stages(const Model& model, DampingLaw law) {
  if (std::ranges::none_of(model.bodies, [](const ModelBody& body) { return body.damping > 0; })) return physics::damping_none;
  return static_cast<std::uint32_t>(law == DampingLaw::internal ? DampingLaw::constant : law);
}

void make_tableau(Arrays& arrays, std::vector<glm::dvec2> rows) {
  PLIANT_EXPECT(rows.size() <= physics::tableau_size);
  rows.resize(physics::tableau_size);
  arrays.make("tableau", rows);
}

bool has_partners(const DeviceBodies& bodies) {
  const Ranks* const ranks = bodies.arrays.device().ranks();
  return ranks != nullptr && ranks->count() > 1;
}

// Whether one rank's kernels cancel rounding in stages of a body. Those for given sums do.
bool cancels_alone(const DeviceBodies& bodies, std::size_t body) {
  const auto variants = bodies.arrays.device().force_variants();
  const std::size_t variant = bodies.force_variants[body];
  return variant == variants.size() || variants[variant].cancels_rounding;
}

std::vector<bool> clustered_of(const Model& model) {
  std::vector<bool> are;
  for (const ModelBody& body : model.bodies) are.push_back(body.is_clustered);
  return are;
}

using AllChangedSums = std::vector<std::shared_ptr<const ChangedSums>>;

std::vector<std::optional<ListBasis>> bases_of(const Model& model, const AllChangedSums& changed) {
  std::vector<std::optional<ListBasis>> bases;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) bases.push_back(list_basis_of(model.bodies[b], changed[b].get()));
  return bases;
}

}  // namespace

std::size_t Stepper::most_drags(const Integrator& integrator) {
  return physics::tableau_size / stage_rows(nystrom_tableau(integrator), true).size();
}

Stepper::Stepper(DeviceBodies& bodies, const Model& model, const Integrator& integrator, DampingLaw law, double time_step,
                 Stages stages)
    : bodies_(bodies),
      cluster_trees_(list_threads(bodies.arrays.device().info())),
      added_forces_(bodies, model),
      internal_damping_(bodies, model, law),
      integrator_(integrator),
      law_(law_of_stages(model, law)),
      time_step_(time_step) {
  PLIANT_EXPECT(allows_damping(integrator, law));
  const std::size_t coordinates = std::size_t{3} * bodies.vertex_count;
  bodies.set_time_step(time_step);
  if (std::ranges::any_of(model.bodies, &ModelBody::is_clustered))
    cluster_forces_.emplace(bodies, model, bases_of(model, AllChangedSums(model.bodies.size())), cluster_trees_);
  else
    bodies.arrays.make<double>("spring_sum",
                               has_partners(bodies) ? coordinates : 1);            // kernels on a processor name it in any case
  bodies.arrays.make<double>("added_force", adds_force() != 0 ? coordinates : 1);  // stages name it in any case
  if (staged_method(integrator) != nullptr) {
    use_tableaus(stages);
    bodies.make_placements(physics::slots_of_stages);
    bodies.arrays.make<double>("acceleration", coordinates * stage_count_);
    bodies.arrays.make<double>("kept_force", 1);  // frames name it in any case
  } else {
    const auto& splitting = std::get<Splitting>(integrator.method);
    stage_count_ = static_cast<std::uint32_t>(splitting.drift.size());
    bodies.make_placements(physics::slots_of_splitting(stage_count_));
    make_tableau(bodies.arrays, splitting_rows(splitting, time_step));
    bodies.arrays.make<double>("acceleration", 1);  // internal damping names it
    bodies.arrays.make<double>("kept_force", coordinates);
  }
  share_sums(model, clustered_of(model));
  bodies.arrays.set_parameter("keeps_force", keeps_force() ? 1u : 0u);
  bodies.arrays.set_parameter("forces_of_a_step", stage_count_);
}

// Bodies that ranks share have the bits that one rank would find, so their tableaus cancel rounding where that one's kernels do.
// A clustered body may come to be shared.
void Stepper::use_tableaus(Stages stages) {
  const bool holds_drag = std::holds_alternative<Nystrom>(integrator_.method) && law_ == physics::damping_constant;
  if (holds_drag) law_ = physics::damping_none;
  std::map<std::pair<double, bool>, std::uint32_t> row_of_kind;
  std::vector<glm::dvec2> rows;
  const auto row_of = [&](double drag, bool cancels_rounding) {
    const auto [place, is_new] = row_of_kind.try_emplace({drag, cancels_rounding}, static_cast<std::uint32_t>(rows.size()));
    if (!is_new) return place->second;
    const NystromTableau tableau = nystrom_tableau(integrator_, stages, drag);
    PLIANT_EXPECT(tableau.c.front() == 0 && tableau.stages > 1);  // the first stage is the step's start, but not the last stage
    stage_count_ = static_cast<std::uint32_t>(tableau.stages);
    std::ranges::copy(stage_rows(tableau, cancels_rounding), std::back_inserter(rows));
    return place->second;
  };
  const bool ever_cancels = stages == Stages::of_result;
  const std::vector<physics::Body> bodies = bodies_.arrays.get<physics::Body>("body").download();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double drag = holds_drag ? bodies[b].damping * bodies[b].inverse_mass * time_step_ : 0;
    const bool is_given = bodies_.force_variants[b] == bodies_.arrays.device().force_variants().size();
    const bool may_be_plain = has_partners(bodies_) && (is_given || !cancels_alone(bodies_, b));
    const bool may_cancel = is_given || !may_be_plain;
    cancelling_rows_.push_back(row_of(drag, ever_cancels && may_cancel));
    plain_rows_.push_back(row_of(drag, ever_cancels && !may_be_plain));
  }
  if (rows.size() > physics::tableau_size)
    throw Error(ErrorKind::input, "",
                fmt::format("bodies have too many rates of damping for {} on several ranks", integrator_.name),
                "use dop853, or one rank");
  make_tableau(bodies_.arrays, std::move(rows));
  bodies_.set_tableau_rows(cancelling_rows_);
}

void Stepper::change_sums(const Model& model, const std::vector<std::shared_ptr<const ChangedSums>>& changed) {
  const std::vector<std::optional<ListBasis>> bases = bases_of(model, changed);
  std::vector<bool> given;
  for (const std::optional<ListBasis>& basis : bases) given.push_back(basis.has_value());
  cluster_forces_ =
      ClusterForces(bodies_, model, bases, cluster_trees_);  // if lists are too long, this throws, and the old ones stay
  bodies_.cut_into_shares(model, given);
  share_sums(model, given);
}

std::vector<Pass> Stepper::first_passes() const {
  return {make_pass(bodies_.arrays, "place_vertices", {}, bodies_.vertex_count)};
}

std::vector<Pass> Stepper::passes(std::uint32_t from_half) const {
  if (const auto* splitting = std::get_if<Splitting>(&integrator_.method)) return splitting_passes(*splitting, from_half);
  return stage_passes("runge_kutta_stage", from_half, [&](std::uint32_t stage) {
    return StageState{physics::slot_of_stage(stage), from_half, stage};
  });
}

Pass Stepper::following_pass(std::uint32_t from_half) const {
  return make_pass(bodies_.arrays, "follow_bodies", {{"from_half", from_half}}, bodies_.body_count);
}

Pass Stepper::restating_pass(std::uint32_t from_half) const {
  return make_pass(bodies_.arrays, "change_frame", {{"from_half", from_half}}, bodies_.vertex_count);
}

void Stepper::share_sums(const Model& model, const std::vector<bool>& are_clustered) {
  if (!has_partners(bodies_)) return;
  shared_sums_.emplace(bodies_, model, are_clustered, *bodies_.arrays.device().ranks());
  bodies_.have_all_sums_given(model);
  if (cancelling_rows_.empty()) return;
  std::vector<std::uint32_t> rows = cancelling_rows_;
  for (std::size_t b = 0; b < rows.size(); ++b)
    if (!cancels_alone(bodies_, b)) rows[b] = plain_rows_[b];
  bodies_.set_tableau_rows(rows);
}

std::vector<Pass> Stepper::sum_passes(std::uint32_t slot, bool only_stale) const {
  std::vector<Pass> passes = cluster_forces_ ? cluster_forces_->passes(slot, only_stale) : std::vector<Pass>();
  if (shared_sums_) std::ranges::move(shared_sums_->passes(slot, only_stale), std::back_inserter(passes));
  return passes;
}

std::vector<Pass> Stepper::refresh_passes() const {
  std::vector<Pass> passes;
  for (const ForceGroup& group : bodies_.force_groups) {
    const KernelId kernel = bodies_.arrays.device().force_kernel("refresh_force", group.variant);
    passes.push_back(make_pass(bodies_.arrays, "refresh_force", kernel, {{"first_share", group.first_share}}, group.share_count));
  }
  run_together(passes);
  std::vector<Pass> all = sum_passes(physics::start_slot, true);
  std::ranges::move(passes, std::back_inserter(all));
  return all;
}

std::vector<Pass> Stepper::force_passes(const StageState& at) const {
  std::vector<Pass> passes = added_forces_.passes(at.slot);
  std::ranges::move(internal_damping_.passes(at, passes.empty()), std::back_inserter(passes));
  return passes;
}

std::vector<Pass> Stepper::stage_passes(std::string_view name, std::uint32_t from_half, const StateOfStage& state_of_stage,
                                        const Parameters& of_all_stages) const {
  const bool comes_between = adds_force() != 0;                     // added forces come between stages
  const auto passes_of = [&](std::optional<std::uint32_t> stage) {  // none: all stages at once
    std::vector<Pass> of_groups;
    for (const ForceGroup& group : bodies_.force_groups) {
      if ((group.all_stages && !comes_between) == stage.has_value()) continue;
      const KernelId kernel =
          bodies_.arrays.device().force_kernel(name, group.variant, stage ? ForceSpan::stage : ForceSpan::step);
      Parameters parameters = {{"from_half", from_half},
                               {"damping_law", law_},
                               {"adds_force", adds_force()},
                               {"stage_count", stage_count_},
                               {"first_share", group.first_share}};
      if (stage)
        parameters.emplace_back("stage_index", *stage);
      else
        parameters.insert(parameters.end(), of_all_stages.begin(), of_all_stages.end());
      of_groups.push_back(make_pass(bodies_.arrays, name, kernel, parameters, group.share_count));
    }
    run_together(of_groups);
    return of_groups;
  };
  std::vector<Pass> passes = passes_of({});
  for (std::uint32_t stage = 0; stage < stage_count_; ++stage) {
    std::vector<Pass> of_stage = passes_of(stage);
    if (of_stage.empty()) continue;
    const StageState state = state_of_stage(stage);
    std::ranges::move(sum_passes(state.slot, false), std::back_inserter(passes));
    std::ranges::move(force_passes(state), std::back_inserter(passes));
    std::ranges::move(of_stage, std::back_inserter(passes));
  }
  return passes;
}

bool Stepper::makes_a_step_in_one_pass() const {
  return adds_force() == 0 && std::ranges::all_of(bodies_.force_groups, &ForceGroup::all_stages);
}

bool Stepper::makes_quiet_steps() const {
  return bodies_.force_groups.size() == 1 && adds_force() == 0 && bodies_.force_groups[0].quiet_steps;
}

Pass Stepper::quiet_pass(std::uint32_t first_half, ForceSpan span) const {
  PLIANT_EXPECT(makes_quiet_steps());
  const ForceGroup& group = bodies_.force_groups[0];
  Parameters parameters = {
      {"first_half", first_half}, {"damping_law", law_}, {"stage_count", stage_count_}, {"first_share", group.first_share}};
  const auto* splitting = std::get_if<Splitting>(&integrator_.method);
  if (splitting != nullptr) std::ranges::copy(first_kick_and_drift(*splitting), std::back_inserter(parameters));
  const KernelId kernel =
      bodies_.arrays.device().force_kernel(splitting != nullptr ? "splitting_stage" : "runge_kutta_stage", group.variant, span);
  return make_pass(bodies_.arrays, "quiet_steps", kernel, parameters, quiet_group_count());
}

std::uint32_t Stepper::quiet_group_count() const {
  const ForceGroup& group = bodies_.force_groups[0];
  return std::min(bodies_.arrays.device().force_variants()[group.variant].quiet_groups, group.share_count);
}

Parameters Stepper::first_kick_and_drift(const Splitting& method) const {
  return {{"first_kick_time", seconds(method.kick[0], time_step_)}, {"first_drift_time", seconds(method.drift[0], time_step_)}};
}

std::vector<Pass> Stepper::splitting_passes(const Splitting& method, std::uint32_t from_half) const {
  const Parameters times = first_kick_and_drift(method);
  const bool in_one_pass = makes_a_step_in_one_pass();
  std::vector<Pass> result;
  if (!in_one_pass) {
    result = refresh_passes();
    const StageState start{physics::start_slot, from_half, 0, seconds(method.kick[0], time_step_)};
    std::ranges::move(force_passes(start), std::back_inserter(result));
    Parameters parameters = {{"from_half", from_half}, {"damping_law", law_}, {"adds_force", adds_force()}};
    parameters.insert(parameters.end(), times.begin(), times.end());
    result.push_back(make_pass(bodies_.arrays, "first_kick", parameters, bodies_.vertex_count));
  }
  Parameters of_all_stages = times;
  of_all_stages.emplace_back("with_first_kick", in_one_pass ? 1u : 0u);
  const auto state_of_stage = [&](std::uint32_t stage) {
    return StageState{physics::slot_of_force(stage), physics::other_half(from_half), 0,
                      seconds(method.kick[stage + 1], time_step_)};
  };
  std::ranges::move(stage_passes("splitting_stage", from_half, state_of_stage, of_all_stages), std::back_inserter(result));
  return result;
}

}  // namespace pliant
