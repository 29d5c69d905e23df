// Step s starts from half (s - 1) mod 2 and ends in the other half, even if it is rejected or empty.
#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/checksum.hpp"
#include "core/error.hpp"
#include "core/expect.hpp"
#include "physics/layout.glsl"
#include "ranks/ranks.hpp"
#include "state/carried_state.hpp"

namespace pliant {
namespace {

using physics::Control;

std::uint64_t total(const Control& control, std::uint32_t counter) {
  return (static_cast<std::uint64_t>(control.total_high[counter]) << 32) | control.total_low[counter];
}

// What has to be known between steps, and what a report has.
constexpr std::string_view clocks[] = {"control", "step_parts", "quiet_steps"};
constexpr std::string_view reported[] = {"control", "step_parts", "pace",  "contact_total",
                                         "status",  "slept",      "tally", "path_state"};

void add_collision_counts(StepReport& report, const Control& control) {
  report.contact_steps = control.contact_steps;
  report.contact_pairs_max = control.contact_pairs_max;
  report.reverted_vertices = total(control, physics::reverted_vertices);
  report.nodes_refitted = total(control, physics::nodes_refitted);
  report.node_tests = total(control, physics::node_tests);
  report.triangle_tests = total(control, physics::triangle_tests);
  report.pairs_beyond_capacity = total(control, physics::pairs_beyond_capacity);
  report.body_pairs_skipped = total(control, physics::body_pairs_skipped);
  report.quiet_steps = total(control, physics::quiet_steps_made);
  report.unsettled_contacts = total(control, physics::unsettled_contacts);
}

void add_force_counts(StepReport& report, const Model& model, const ClusterWatch* watch,
                      const std::vector<physics::Tally>& tallies) {
  for (std::size_t b = 0; b < tallies.size(); ++b) {
    const std::uint64_t evaluations = tallies[b].force_evaluations, vertices = model.bodies[b].vertex_count;
    report.force_evaluations += evaluations;
    report.forces_skipped += tallies[b].forces_skipped;
    report.frame_changes += tallies[b].frame_changes;
    report.steps_at_rest += tallies[b].steps_at_rest;
    report.steps_asleep += tallies[b].steps_asleep;
    report.pair_interactions += watch != nullptr ? watch->interactions(b, evaluations) : evaluations * vertices * (vertices - 1);
  }
}

// What bears sleepers has given them the opposite of the momentum that it took.
void add_slept(StepReport& report, const std::vector<double>& slept) {
  for (std::uint32_t b = 0; 4 * b < slept.size(); ++b) {
    report.energy_slept += slept[physics::energy_slept_of(b)];
    const double* const momentum = &slept[physics::momentum_slept_of(b)];
    report.response.outside_impulse -= glm::dvec3(momentum[0], momentum[1], momentum[2]);
  }
}

// A step whose error ends the run stands. Its state may be finite or not.
bool is_finite(const State& state, const Model& model) {
  return std::ranges::all_of(state.motion, [](double number) { return std::isfinite(number); }) &&
         std::ranges::all_of(state.world_positions(model), [](const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); });
}

void expect_room_for_pairs(std::uint64_t lost) {
  if (lost == 0) return;
  throw Error(ErrorKind::device, "", "more bodies are near each other at once than there is room for",
              "use fewer bodies, or bodies that are further apart");
}

// A rank alone may have had no memory for new lists. Its sums would differ from then on, and the ranks that share them, too.
void expect_same_sums(Ranks& ranks, const std::vector<std::shared_ptr<const ChangedSums>>& changed) {
  std::uint64_t sums = checksum_of_nothing;
  for (const std::shared_ptr<const ChangedSums>& of_body : changed) {
    const std::array<double, 3> told{of_body ? static_cast<double>(of_body->changes) : 0,
                                     of_body && of_body->are_direct ? 1.0 : 0.0, of_body ? of_body->accuracy : 0};
    sums = checksum(std::as_bytes(std::span(told)), sums);
  }
  if (const auto rank = first_to_differ(ranks, sums))  // each tells, because each has found it
    throw Error(ErrorKind::device, fmt::format("rank {}", *rank), "has made other lists of clusters than rank 0",
                "give all ranks the same memory, or use forces = \"direct\"");
}

void expect_groups_met(const std::vector<physics::Status>& statuses) {
  if (std::ranges::find(statuses, physics::halted_waiting, &physics::Status::activity) == statuses.end()) return;
  throw Error(
      ErrorKind::device, "",
      "the GPU did not run all work groups at once, though it has a multiprocessor for each, or it stopped a long loop, as "
      "Mesa's llvmpipe does",
      "close other programs that use the GPU, or use --device cpu");
}

}  // namespace

Simulation::Simulation(Device& device, const Model& model, const State& start, const TimePlan& plan,
                       const CollisionDescription& collision)
    : device_(device),
      model_(model),
      bodies_(device, model, start),
      stepper_(bodies_, model, *plan.integrator, plan.damping_law, plan.time_step,
               plan.tolerance ? Stages::of_estimates : Stages::of_result),
      collider_(bodies_, model, collision,
                {.vary_in_length = plan.tolerance.has_value(),
                 .have_forces_at_ends = has_forces_at_ends(*plan.integrator),
                 .damping_law = plan.damping_law},
                {}, plan.sleep),
      fixed_step_(plan.time_step) {
  if (plan.tolerance) {
    pacer_.emplace(
        bodies_, model, stepper_, *plan.integrator, plan.damping_law,
        PaceLimits{
            .tolerance = *plan.tolerance, .first_step = plan.time_step, .largest_step = plan.step_bound, .end = plan.duration});
    known_pace_ = pacer_->pace();
  }
  device.run(stepper_.first_passes());
  if (stepper_.cluster_forces() != nullptr) {
    watch_.emplace(bodies_, model_, stepper_, plan.tolerance ? std::nullopt : std::optional(plan.time_step));
    if (!start.changed_sums.empty()) watch_->use(start.changed_sums);
  }
  skip({});
}

void Simulation::skip(const Skipping& what) {
  bodies_.arrays.set_parameter("skips", (what.forces ? physics::skips_forces : 0) | (what.rest ? physics::skips_rest : 0));
  if (!what.rest) bodies_.look_at_bodies_at_rest();
  skipped_ = what;
  record();
}

void Simulation::record() {
  for (std::uint32_t half = 0; half < 2; ++half) schedules_[half] = schedule(half);
  if (watch_) watch_->record();
  quiet_.reset();
  if (skipped_ == Skipping{} && !pacer_) quiet_.emplace(bodies_, stepper_, collider_);
}

void Simulation::watch(std::uint64_t steps) {
  if (!watch_ || steps < watch_->next_check()) return;
  try {
    if (watch_->check(steps, [this] { return state(); })) record();
  } catch (...) {
    record();  // a change may stand
    throw;
  }
  if (device_.ranks() != nullptr) expect_same_sums(*device_.ranks(), watch_->changed_sums());
}

std::vector<Pass> Simulation::schedule(std::uint32_t from_half) const {
  return step_passes(bodies_, stepper_, collider_, from_half, pacer_ ? &*pacer_ : nullptr);
}

void Simulation::queue(std::uint64_t steps) {
  steps_to_next_try_ -= std::min(steps, steps_to_next_try_);
  progress_.reset();
  is_anew_ = false;
  for (std::uint64_t k = 0; k < steps; ++k) {
    run(schedules_[queued_steps_++ & 1]);
  }
}

void Simulation::queue_in_batches(std::uint64_t steps, const std::function<bool()>& stops) {
  if (!stops) return queue(steps);
  for (std::uint64_t left = steps; left > 0;) {
    const std::uint64_t queued = std::min(left, most_steps_at_once);
    queue(queued);
    left -= queued;
    if (left == 0) return;
    device_.finish();  // otherwise a GPU may not have begun when `stops` is asked
    if (stops()) return;
  }
}

void Simulation::run(std::span<const Pass> passes) {
  for (const Pass& pass : passes) launches_of_steps_ += pass.item_count > 0 ? 1 : 0;
  if (timed_)
    run_timed(device_, passes, pass_seconds_);
  else
    device_.run(passes);
}

// Steps up to the next check at a time. It reads nothing to know how many there are, unless steps fall into parts.
void Simulation::advance(std::uint64_t steps, const std::function<bool()>& stops) {
  PLIANT_EXPECT(!pacer_);
  if (!watch_) return advance_unwatched(steps, stops);
  const auto made = [this] { return parts() != nullptr ? whole_steps() : queued_steps_; };
  const std::uint64_t target = made() + steps;
  for (std::uint64_t now = made(); now < target;) {
    watch(now);
    const std::uint64_t wanted = std::min(target, watch_->next_check());
    advance_unwatched(wanted - now, stops);
    now = made();
    if (now < wanted || (now < target && stops && stops())) return;
  }
  watch(made());
}

void Simulation::advance_part() {
  if (watch_) watch(whole_steps());
  queue(1);
}

void Simulation::advance_unwatched(std::uint64_t steps, const std::function<bool()>& stops) {
  if (parts() == nullptr && (!tries_quiet_steps() || steps < physics::fewest_quiet_steps)) return queue_in_batches(steps, stops);
  const std::uint64_t target = whole_steps() + steps;
  for (std::uint64_t left = steps; left > 0 && control().non_finite_step == 0;) {
    if (make_quiet_steps(left) == 0) {
      const std::uint64_t to_next_try = std::max<std::uint64_t>(steps_to_next_try_, 1);
      queue(std::min(left, tries_quiet_steps() ? to_next_try : most_steps_at_once));
    }
    left = target - std::min(whole_steps(), target);
    if (left > 0 && stops && stops()) return;
  }
}

std::uint64_t Simulation::whole_steps() {
  if (!progress_) read_progress(clocks);
  return progress_->steps;
}

// What has been uploaded does not say what came before, so the first step is none of them. If a try makes none, others follow,
// twice as many each time.
std::uint64_t Simulation::make_quiet_steps(std::uint64_t most) {
  if (!tries_quiet_steps() || steps_to_next_try_ > 0 || is_anew_ || most < physics::fewest_quiet_steps) return 0;
  quiet_->aim_at(most);
  run(quiet_->passes(half()));
  read_progress(clocks);  // and with it what the next line takes
  const std::uint32_t made = quiet_->take_made();
  steps_to_next_try_ = made > 0 ? 0 : pause_;
  pause_ = made > 0 ? 1 : std::min(2 * pause_, most_steps_at_once);
  queued_steps_ += made;
  return made;
}

const DeviceArray<physics::StepParts>* Simulation::parts() const {
  return collider_.response() != nullptr ? collider_.response()->step_parts() : nullptr;
}

void Simulation::add_parts(StepReport& report) const {
  const physics::StepParts made = parts()->download().front();
  report.held_parts = made.held;
  if (pacer_) return;
  report.steps = made.steps;
  const double part_over = 1 - made.left / static_cast<double>(physics::smallest_parts);  // of the step in hand
  report.time = (static_cast<double>(made.steps) + part_over) * fixed_step_;
  report.substeps = made.parts - made.steps;
}

StepReport Simulation::advance_toward(double time, std::uint64_t most_steps) {
  PLIANT_EXPECT(pacer_.has_value());
  pacer_->aim_at(time);
  std::uint64_t most = most_steps;
  if (watch_) {
    watch(known_pace_.accepted);
    most = std::min(most, watch_->next_check() - known_pace_.accepted);
  }
  queue(steps_toward(time, known_pace_, most));
  return report();
}

StepReport Simulation::advance_to(double time) {
  StepReport last = advance_toward(time);
  while (last.time < time && !last.breakdown) last = advance_toward(time);
  return last;
}

void Simulation::pull(const Pull& by, double seconds) {
  if (!grip_ || grip_->vertex() != by.vertex) grip_.emplace(bodies_, model_, by.vertex);
  grip_->aim_at(by.target, seconds);
  device_.run(grip_->passes(half()));
}

void Simulation::send(std::uint32_t body, std::span<const physics::PathKey> keys) {
  PLIANT_EXPECT(model_.bodies[body].path && model_.bodies[body].path->keys.size() == keys.size());
  const physics::Path way = bodies_.arrays.get<physics::Path>("path").download(body, 1).front();
  physics::PathState state = path_state(body);
  state.time = 0;
  bodies_.arrays.get<physics::PathKey>("path_key").upload(keys, way.first_key);
  bodies_.path_states->upload(std::span(&state, 1), body);
}

void Simulation::copy_path_keys(Model& into) const {
  for (std::size_t b = 0; b < into.bodies.size(); ++b)
    if (into.bodies[b].path) into.bodies[b].path->keys = path_keys(static_cast<std::uint32_t>(b));
}

std::vector<physics::PathKey> Simulation::path_keys(std::uint32_t body) const {
  const physics::Path way = bodies_.arrays.get<physics::Path>("path").download(body, 1).front();
  return bodies_.arrays.get<physics::PathKey>("path_key").download(way.first_key, way.key_count);
}

physics::PathState Simulation::path_state(std::uint32_t body) const { return bodies_.path_states->download(body, 1).front(); }

void Simulation::read_progress(std::span<const std::string_view> arrays) {
  device_.read_ahead(bodies_.arrays.made_buffers(arrays));
  Progress& read = progress_.emplace(Progress{.control = bodies_.control.download().front()});
  read.steps = parts() != nullptr ? parts()->download().front().steps : read.control.step - 1;
}

const Control& Simulation::control() {
  if (!progress_) read_progress(clocks);
  return progress_->control;
}

std::uint32_t Simulation::half() {
  const std::uint32_t halted_at = control().non_finite_step;
  return static_cast<std::uint32_t>((halted_at != 0 ? halted_at : queued_steps_) & 1);
}

void Simulation::add_pace(StepReport& report) {
  known_pace_ = pacer_->pace();
  report.steps = known_pace_.accepted;
  report.time = known_pace_.time;
  report.adaptive = AdaptiveReport{known_pace_.rejected, known_pace_.rejected_in_contact, known_pace_.smallest_taken,
                                   known_pace_.largest_taken, known_pace_.allowed};
}

StepReport Simulation::report() {
  read_progress(reported);
  const Control& control = progress_->control;
  StepReport report;
  report.steps = control.step - 1;
  report.time = static_cast<double>(report.steps) * fixed_step_;
  if (pacer_) add_pace(report);
  if (parts() != nullptr) add_parts(report);
  if (collider_.response() != nullptr) report.response = collider_.response()->report();
  if (control.non_finite_step != 0) {
    const std::uint32_t body = model_.body_index(control.non_finite_vertex);
    report.breakdown = Breakdown{.step = report.steps,
                                 .body = body,
                                 .vertex = control.non_finite_vertex - model_.bodies[body].first_vertex,
                                 .failed_step = known_pace_.failed_step,
                                 .is_finite = known_pace_.failed_step > 0 && is_finite(state(), model_),
                                 .takes_too_many = known_pace_.failure == physics::too_many_steps};
  }
  add_collision_counts(report, control);
  const std::uint64_t searches = report.steps + report.substeps + (report.adaptive ? report.adaptive->rejected : 0);
  if (collider_.response() != nullptr && collider_.uses_trees())
    report.refits_skipped = searches * model_.bodies.size() - total(control, physics::trees_refitted);
  if (!collider_.response_row().keeps_apart)
    expect_room_for_pairs(total(control, physics::body_pairs_lost));  // else the step is held
  const std::vector<physics::Status> statuses = bodies_.statuses.download();
  expect_groups_met(statuses);
  for (const physics::Status& status : statuses) report.bodies_asleep += status.asleep;
  add_slept(report, bodies_.arrays.get<double>("slept").download());
  add_force_counts(report, model_, watch_ ? &*watch_ : nullptr, bodies_.tallies.download());
  if (watch_) report.clusters = watch_->report();
  return report;
}

State Simulation::state() {
  State state;
  read_state(state);
  return state;
}

void Simulation::read_state(State& into) {
  bodies_.download(half(), into);
  if (watch_)
    into.changed_sums = watch_->changed_sums();
  else
    into.changed_sums.clear();
}

std::vector<glm::vec4> Simulation::world_positions() {
  std::vector<glm::vec4> positions(bodies_.vertex_count);
  read_world_positions(positions);
  return positions;
}

void Simulation::read_world_positions(std::span<glm::vec4> into) {
  PLIANT_EXPECT(into.size() == bodies_.vertex_count);
  bodies_.world_positions.download(into, first_position());
}

std::string Simulation::save() {
  ByteWriter saved;
  saved.put(queued_steps_);
  write_arrays(device_, bodies_.arrays.carried(), saved);
  if (collider_.response() != nullptr) saved.put(collider_.response()->save());
  saved.put(watch_ ? watch_->save() : std::string());  // which bodies are clustered depends on the device
  return saved.take();
}

void Simulation::restore(std::string_view saved) {
  ByteReader from(saved);
  progress_.reset();
  is_anew_ = true;
  queued_steps_ = from.get<std::uint64_t>();
  read_arrays(device_, bodies_.arrays.carried(), from);
  bodies_.begin_anew();
  if (collider_.response() != nullptr) collider_.response()->restore(from.get<std::string>());
  const auto watched = from.get<std::string>();
  if (watch_ && watch_->restore(watched)) record();
  if (!from.at_end()) throw Error(ErrorKind::input, "", "its state has more bytes than its scene needs", "");
  if (pacer_) known_pace_ = pacer_->pace();
}

std::vector<std::uint32_t> Simulation::touching_vertices() {
  const std::uint32_t latest = control().step - 1;
  const std::vector<std::uint32_t> marks = collider_.touching().marks();
  std::vector<std::uint32_t> touching;
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    if (latest > 0 && marks[i] == latest) touching.push_back(i);
  return touching;
}

std::vector<ContactImpulse> Simulation::contact_impulses() {
  if (is_anew_ || collider_.response() == nullptr) return {};
  return collider_.response()->contact_impulses();
}

Intersections Simulation::intersections() {
  const Control saved = control();
  Control probe = saved;
  probe.step = 0xffffffffu;  // no step has this number
  probe.non_finite_step = 0;
  probe.non_finite_vertex = physics::no_vertex;
  const std::uint32_t current = half();
  const std::vector<std::uint32_t> marks_before = collider_.touching().marks();
  const std::vector<physics::Status> statuses_before = bodies_.statuses.download();
  auto& boxes = bodies_.arrays.get<physics::BoxBits>("body_box");
  const std::vector<physics::BoxBits> boxes_before = boxes.download();
  bodies_.control.upload(std::span(&probe, 1));
  bodies_.prepare_search();
  const Pass bounding = collider_.bounding_pass(current);
  device_.run({&bounding, 1});
  device_.run(collider_.search_passes(current));

  const Control found = bodies_.control.download().front();
  Intersections result{.pairs = found.count[physics::contact_pairs], .bodies = {}};
  const std::vector<std::uint32_t> marks = collider_.touching().marks();
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    if (marks[i] == probe.step && (result.bodies.empty() || result.bodies.back() != model_.body_index(i)))
      result.bodies.push_back(model_.body_index(i));
  collider_.touching().restore_marks(marks_before);
  bodies_.control.upload(std::span(&saved, 1));
  bodies_.statuses.upload(statuses_before);
  boxes.upload(boxes_before);
  expect_room_for_pairs(found.count[physics::body_pairs_lost]);
  return result;
}

}  // namespace pliant
