#include "simulation/cluster_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <system_error>
#include <utility>

#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "dynamics/clusters/cluster_pairs.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "dynamics/stability.hpp"
#include "physics/layout.glsl"

namespace pliant {
namespace {

constexpr std::string_view measured[] = {"control", "status", "leaf_square"};
constexpr double radians_between_checks = 3;  // half a period: as long as a body takes to collapse and open again
constexpr std::uint32_t most_changes = 8;     // of how a body's springs are summed: each changes its energy
constexpr double unknown_energy = std::numeric_limits<double>::quiet_NaN();  // of one that could not be summed
constexpr double most_strained = 2;   // error over the tolerance up to which lists still beat direct sums
constexpr double aimed_at = 0.7;      // error over the tolerance that more exact lists are made for. Less costs more
constexpr double finest_share = 0.1;  // tau of the finest lists, over that of the body's first ones

// Changes up to this number aim at an error. Later ones that need more exact lists take the finest, which last longest.
constexpr std::uint32_t last_aimed = most_changes / 2;

double epsilon_of(int precision) { return precision == 64 ? 0x1p-52 : 0x1p-23; }

// Sums are as inexact as 32 roundings of what they add up. Where a body is hardly deformed, rounding of placements is all that
// there is. It is 4 roundings of each spring's length, which is about 1 in the body's unit.
bool is_rounding(const ClusterErrors& errors, std::uint32_t vertex_count, int precision) {
  return errors.error <= epsilon_of(precision) * std::max(32 * errors.size, 4.0 * vertex_count);
}

// Returns after how many steps a check follows the last one.
std::uint64_t interval_of(const Model& model, std::optional<double> time_step) {
  if (!time_step) return 3;
  double fastest = 0;
  for (const ModelBody& body : model.bodies)
    if (body.is_clustered) fastest = std::max(fastest, stiffest_frequency(body));
  const double steps = radians_between_checks / (fastest * *time_step);
  return static_cast<std::uint64_t>(std::clamp(steps, 1.0, 1000.0));
}

bool is_ready(const std::future<double>& energy) { return energy.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

bool sums_springs(const physics::Status& status) {
  return status.activity == physics::moving && status.deformed != 0 && !physics::is_still(status);
}

}  // namespace

std::optional<double> next_accuracy(double accuracy, double excess, double finest, bool aims) {
  if (accuracy <= finest) return {};
  const double wanted = aims ? accuracy * accuracy_of(aimed_at) / accuracy_of(excess) : 0;
  return wanted < 2 * finest ? finest : wanted;
}

double energy_change_of(ModelBody body, std::shared_ptr<const ClusterTree> tree, unsigned threads,
                        std::shared_ptr<const ChangedSums> before, std::shared_ptr<const ChangedSums> after,
                        std::vector<glm::dvec3> rest, std::vector<glm::dvec3> displacements) {
  try {
    ThreadPool pool(threads);
    const auto energy_with = [&](const std::shared_ptr<const ChangedSums>& sums) {
      const ListBasis basis = *list_basis_of(body, sums.get());
      return body.stiffness * ClusterSprings(tree, rest, basis.accuracy, basis.displacements).energy(pool, displacements);
    };
    return std::abs(energy_with(after) - energy_with(before));
  } catch (const std::bad_alloc&) {
    return unknown_energy;
  } catch (const Error& problem) {
    if (problem.kind() != ErrorKind::device) throw;
    return unknown_energy;  // there are too few threads
  }
}

ClusterWatch::ClusterWatch(DeviceBodies& bodies, const Model& model, Stepper& stepper, std::optional<double> time_step)
    : bodies_(bodies),
      model_(model),
      stepper_(stepper),
      interval_(interval_of(model, time_step)),
      changed_(model.bodies.size()),
      counted_(model.bodies.size()) {
  record();
}

void ClusterWatch::record() { measuring_ = stepper_.cluster_forces()->measuring_passes(physics::start_slot); }

bool ClusterWatch::check(std::uint64_t steps, const std::function<State()>& state) {
  next_check_ = (steps / interval_ + 1) * interval_;
  const auto before = changed_;
  const std::vector<std::optional<double>> errors = measure();
  for (std::size_t b = 0; b < errors.size(); ++b) {
    if (!errors[b]) continue;
    ++report_.checks;
    double error = *errors[b];
    if (!(error <= limit_of(b))) {
      const double mended = improve(b, state(), error);
      if (steps == 0) error = mended;  // no step has had the first one
    }
    report_.largest_error = std::max(report_.largest_error, error);
    if (const double excess = error / force_tolerance_of(model_.bodies[b]); excess > report_.largest_excess) {
      report_.largest_excess = excess;
      report_.worst_body = static_cast<std::uint32_t>(b);
    }
  }
  return changed_ != before;
}

double ClusterWatch::limit_of(std::size_t body) const {
  const bool is_strained = changed_[body] && changed_[body]->are_strained;
  return (is_strained ? most_strained : 1) * force_tolerance_of(model_.bodies[body]);
}

std::vector<std::optional<double>> ClusterWatch::measure() {
  Device& device = bodies_.arrays.device();
  std::vector<std::optional<double>> relative(model_.bodies.size());
  const ClusterForces& forces = *stepper_.cluster_forces();
  device.run(measuring_);
  device.read_ahead(bodies_.arrays.made_buffers(measured));
  if (bodies_.control.download().front().non_finite_step != 0) return relative;
  const std::vector<physics::Status> statuses = bodies_.statuses.download();
  const std::vector<ClusterErrors> errors = forces.errors();
  for (std::size_t b = 0; b < relative.size(); ++b) {
    if (forces.springs_of(b) == 0 || !sums_springs(statuses[b])) continue;
    relative[b] = is_rounding(errors[b], model_.bodies[b].vertex_count, device.precision()) ? 0 : errors[b].relative();
  }
  return relative;
}

// Of lists that miss the tolerance by little it keeps the first ones: each change makes another body, and more exact lists cost
// more.
double ClusterWatch::improve(std::size_t body, const State& state, double error) {
  struct Tried {
    std::shared_ptr<const ChangedSums> sums;
    double error;
  };
  const double tolerance = force_tolerance_of(model_.bodies[body]), standard = accuracy_of(tolerance);
  const std::shared_ptr<const ChangedSums> before = changed_[body];
  std::vector<Tried> all_tried = {{before, error}};
  ChangedSums lists{.changes = 1 + (before ? before->changes : 0), .displacements = state.displacements_of(model_.bodies[body])};
  bool has_room = true;
  std::optional<double> accuracy;
  if (lists.changes <= most_changes) accuracy = before ? before->accuracy : standard;
  while (accuracy) {
    lists.accuracy = *accuracy;
    try {
      change(body, std::make_shared<const ChangedSums>(lists));
    } catch (const std::bad_alloc&) {
      has_room = false;
      break;
    } catch (const Error& problem) {
      if (problem.kind() != ErrorKind::input && problem.kind() != ErrorKind::device) throw;
      has_room = problem.kind() == ErrorKind::input;  // so many vertices have come together that lists would be too long
      break;
    }
    all_tried.push_back({changed_[body], measure()[body].value_or(0)});
    if (all_tried.back().error <= tolerance) {
      note_lists(body, state, before);
      return all_tried.back().error;
    }
    const bool aims = lists.changes <= last_aimed && all_tried.size() == 2;  // only the first try: all_tried[0] is from before
    accuracy = next_accuracy(*accuracy, all_tried.back().error / tolerance, finest_share * standard, aims);
  }
  const auto kept = std::ranges::find_if(all_tried, [&](const Tried& tried) { return tried.error <= most_strained * tolerance; });
  ChangedSums sums;
  sums.are_direct = !has_room || kept == all_tried.end();
  if (sums.are_direct)
    sums.changes = lists.changes;
  else if (kept->sums)
    sums = *kept->sums;
  else
    sums.accuracy = standard;
  sums.are_strained = true;
  const bool are_in_place = !sums.are_direct && kept->sums == changed_[body];
  auto now = std::make_shared<const ChangedSums>(std::move(sums));
  if (are_in_place)
    changed_[body] = std::move(now);
  else
    change(body, std::move(now));
  note_lists(body, state, before);
  return changed_[body]->are_direct ? 0 : kept->error;
}

void ClusterWatch::note_lists(std::size_t body, const State& state, const std::shared_ptr<const ChangedSums>& before) {
  const ChangedSums& now = *changed_[body];
  if (now.are_direct || now.changes == (before ? before->changes : 0)) return;  // the energy of all springs may take minutes
  ++report_.lists_made;
  const ModelBody& of = model_.bodies[body];
  try {
    energy_changes_.push_back(std::async(std::launch::async, energy_change_of, of,
                                         stepper_.cluster_trees().of(model_, static_cast<std::uint32_t>(body)),
                                         list_threads(bodies_.arrays.device().info()), before, changed_[body],
                                         model_.rest_positions_of(of), state.displacements_of(of)));
  } catch (const std::bad_alloc&) {
    energy_change_ = unknown_energy;
  } catch (const std::system_error&) {
    energy_change_ = unknown_energy;
  }
}

void ClusterWatch::add_energy_change() {
  std::future<double> first = std::move(energy_changes_.front());
  energy_changes_.erase(energy_changes_.begin());
  energy_change_ += first.get();
}

double ClusterWatch::energy_change() {
  while (!energy_changes_.empty()) add_energy_change();
  return energy_change_;
}

bool ClusterWatch::knows_energy_change() const { return std::ranges::all_of(energy_changes_, is_ready); }

void ClusterWatch::change(std::size_t body, std::shared_ptr<const ChangedSums> sums) {
  const std::uint64_t evaluations = bodies_.tallies.download()[body].force_evaluations;
  const Counted counted{evaluations, interactions(body, evaluations)};
  auto changed = changed_;
  changed[body] = std::move(sums);
  stepper_.change_sums(model_, changed);
  record();
  changed_ = std::move(changed);
  counted_[body] = counted;
  std::vector<physics::Status> statuses = bodies_.statuses.download();
  statuses[body].force_stale = 1;
  bodies_.statuses.upload(statuses);
}

ClusterReport ClusterWatch::report() const {
  ClusterReport report = report_;
  for (std::uint32_t b = 0; b < changed_.size(); ++b)
    if (changed_[b] && changed_[b]->are_direct) report.direct.push_back(b);
  return report;
}

std::uint64_t ClusterWatch::interactions(std::size_t body, std::uint64_t evaluations) const {
  const std::uint64_t vertices = model_.bodies[body].vertex_count, springs = stepper_.cluster_forces()->springs_of(body);
  const std::uint64_t each = springs > 0 ? 2 * springs : vertices * (vertices - 1);
  return counted_[body].interactions + (evaluations - counted_[body].evaluations) * each;
}

bool ClusterWatch::use(const std::vector<std::shared_ptr<const ChangedSums>>& changed) {
  if (changed == changed_) return false;
  stepper_.change_sums(model_, changed);
  changed_ = changed;
  return true;
}

std::string ClusterWatch::save() {
  ByteWriter to;
  to(next_check_, report_.checks, report_.largest_error, report_.largest_excess, report_.worst_body, report_.lists_made,
     energy_change(), counted_);
  for (const std::shared_ptr<const ChangedSums>& sums : changed_) {
    to(sums != nullptr);
    if (sums) to(sums->changes, sums->are_strained, sums->are_direct, sums->accuracy, sums->displacements);
  }
  return to.take();
}

bool ClusterWatch::restore(std::string_view saved) {
  energy_changes_.clear();
  std::vector<std::shared_ptr<const ChangedSums>> changed(model_.bodies.size());
  if (saved.empty()) {
    report_ = {};
    energy_change_ = 0;
    next_check_ = 0;
    const std::vector<physics::Tally> tallies = bodies_.tallies.download();
    for (std::size_t b = 0; b < changed.size(); ++b) {
      const std::uint64_t vertices = model_.bodies[b].vertex_count, evaluations = tallies[b].force_evaluations;
      counted_[b] = {evaluations, evaluations * vertices * (vertices - 1)};
    }
    return use(changed);
  }
  ByteReader from(saved);
  from(next_check_, report_.checks, report_.largest_error, report_.largest_excess, report_.worst_body, report_.lists_made,
       energy_change_, counted_);
  for (std::size_t b = 0; b < changed.size(); ++b) {
    if (!from.get<bool>()) continue;
    ChangedSums sums;
    from(sums.changes, sums.are_strained, sums.are_direct, sums.accuracy, sums.displacements);
    changed[b] = changed_[b] && *changed_[b] == sums ? changed_[b] : std::make_shared<const ChangedSums>(std::move(sums));
  }
  return use(changed);
}

}  // namespace pliant
