#include "run/report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "core/version.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "dynamics/forces/force.hpp"
#include "run/interrupts.hpp"
#include "run/progress_bar.hpp"
#include "simulation/breakdown.hpp"
#include "simulation/overlap.hpp"

namespace pliant {
namespace {

// A run warns if its energy has grown by this part or more of what it has had.
constexpr double told_gain = 0.05;

// Such growth ends a run whose steps fall into parts. It would not become non-finite, but have ever more parts. A run that has
// had less than this part of energy_scale() is compared with that: what is little to deformed bodies may be much to it.
constexpr double ruinous_growth = 1e3, least_part_to_ruin = 1e-3;

// A run warns of cuts if there are so many, and this part of all motions of vertices in parts of steps with a contact. Ordinary
// contacts cut less than 2e-4 of them.
constexpr double fewest_cuts = 100, told_share_of_cuts = 0.01;

// Returns the largest energy_scale of a force [J].
double energy_scale(const Model& model) {
  double scale = 1e12 * std::numeric_limits<double>::min();
  for (const ModelBody& body : model.bodies)
    for (const Force& force : forces())
      if (feels(body, force)) scale = std::max(scale, force.energy_scale(body));
  return scale;
}

// Returns the energy below which a change counts as rounding [J].
double smallest_energy(const Model& model) { return 1e-12 * energy_scale(model); }

// A body that forces set in motion from rest starts with no energy to compare with.
bool is_driven_from_rest(const Model& model) {
  return std::ranges::any_of(forces(), [&](const Force& force) { return !force.is_zero_at_rest && any_feels(model, force); });
}

// Returns the energy that gains are compared with [J]. It never falls. The largest change of the gravitational energy counts: a
// body that comes back to where it began has had it. If a force sets bodies at rest in motion, the most energy in motion counts.
double energy_had(const RunProgress& progress, const Model& model) {
  const double had =
      progress.first.kinetic + progress.first.elastic_size + progress.most_of_gravity + progress.most_work_of_scripts;
  return is_driven_from_rest(model) ? std::max(had, progress.most_in_motion) : had;
}

std::string told_growth_of(const RunProgress& progress, const Model& model) {
  const double gain = progress.most_gained, had = energy_had(progress, model), time = progress.time_of_gain;
  if (had < smallest_energy(model))
    return fmt::format("the energy has grown by {:.3g} J at {:.6g} s, and was too small at the start to compare with", gain,
                       time);
  if (is_driven_from_rest(model))
    return fmt::format("the energy has grown by {:.3g} times the most energy in motion at {:.6g} s", gain / had, time);
  return fmt::format("the energy has grown {:.3g}-fold at {:.6g} s", 1 + gain / had, time);
}

std::string length_of_steps(const TimePlan& plan, const StepReport& report) {
  if (!report.adaptive) return fmt::format("{:.6g} s", plan.time_step);
  return fmt::format("{:.3g} to {:.3g} s ({} rejected, {} of them in contact)", report.adaptive->smallest_step,
                     report.adaptive->largest_step, report.adaptive->rejected, report.adaptive->rejected_in_contact);
}

std::string told_checks(const ClusterReport& clusters) {
  if (clusters.checks == 0) return "forces of clustered bodies were never checked: no check was due while one was deformed";
  const std::string lists = clusters.lists_made == 0   ? ""
                            : clusters.lists_made == 1 ? "; clusters were listed anew once"
                                                       : fmt::format("; clusters were listed anew {} times", clusters.lists_made);
  return fmt::format("forces of clustered bodies erred by at most {:.2g} in {} checks{}", clusters.largest_error, clusters.checks,
                     lists);
}

void show_timings(const Simulation& simulation, std::uint64_t steps) {
  const std::map<std::string_view, double>& pass_seconds = simulation.pass_seconds();
  double all = 0;
  for (const auto& [pass, seconds] : pass_seconds) all += seconds;
  fmt::print("{:<20} {:>12} {:>8}\n", "pass", "us a step", "share");
  for (const auto& [pass, seconds] : pass_seconds)
    fmt::print("{:<20} {:>12.2f} {:>6.1f} %\n", pass, 1e6 * seconds / static_cast<double>(steps), 100 * seconds / all);
  fmt::print("{:<20} {:>12.2f}\n", "together", 1e6 * all / static_cast<double>(steps));
  fmt::print("{:<20} {:>12.2f}\n", "launches a step",
             static_cast<double>(simulation.launches_of_steps()) / static_cast<double>(steps));
}

bool meets_by_impulses(const Simulation& simulation) { return simulation.collider().response_row().gives_impulses; }

// Where contacts by impulses make the trouble. Their bounds rule steps then, not errors.
std::string_view shorter_steps_in_contact(const StepReport& report) {
  return report.adaptive ? "a fixed time_step in place of the tolerance" : "a shorter time step";
}

std::string_view shorter_steps(const RunStatus& status) {
  if (meets_by_impulses(*status.run.simulation) && status.report.contact_steps > 0)
    return shorter_steps_in_contact(status.report);
  return status.report.adaptive ? "a smaller tolerance" : "a shorter time step";
}

std::size_t ranks_of(const PreparedRun& run) { return run.device->ranks() != nullptr ? run.device->ranks()->count() : 1; }

}  // namespace

double energy_gained(const RunProgress& progress) {
  return progress.latest.energy() - progress.work_of_scripts - progress.first.energy();
}

bool has_blown_up(const RunStatus& status) {
  const Model& model = status.run.start.model;
  const double had = std::max(energy_had(status.progress, model), least_part_to_ruin * energy_scale(model));
  return status.report.substeps > 0 && energy_gained(status.progress) >= ruinous_growth * had;
}

std::optional<std::string> instability_of(const RunStatus& status) {
  const auto& [options, run, progress, report] = status;
  if (report.breakdown) return describe_breakdown(*report.breakdown, run.plan, run.start.model);
  const Model& model = run.start.model;
  if (has_blown_up(status))
    return fmt::format("{}, which ends the run at step {}; try {}", told_growth_of(progress, model), report.steps,
                       shorter_steps(status));
  if (progress.most_gained < told_gain * std::max(energy_had(progress, model), smallest_energy(model))) return {};
  return fmt::format(
      "{}: {}", told_growth_of(progress, model),
      cause_of_growth(progress.most_gained, run.simulation->energy_changed_by_lists(), report, shorter_steps(status)));
}

std::string cause_of_growth(double gained, double by_lists, const StepReport& report, std::string_view shorter) {
  if (by_lists >= 0.5 * gained)
    return "lists of clusters that were made anew have changed it; try forces = \"direct\", or damping";
  const bool may_be_lists = std::isnan(by_lists);
  return fmt::format("{}{}; try {}{}", may_be_lists ? "lists of clusters that were made anew may have changed it, or " : "",
                     report.contact_steps > 0 ? "contacts have added it, or the motion is unstable"
                                              : "the motion is unstable, or the steps are too long for the method",
                     may_be_lists ? "forces = \"direct\", damping or " : "", shorter);
}

std::vector<std::string> contact_troubles_of(const StepReport& report, std::uint64_t moving_vertices, int precision) {
  std::vector<std::string> told;
  if (report.held_parts > 0)
    told.push_back(fmt::format("no body moved in {} parts of steps, because contacts were too many, or could not be proven apart",
                               report.held_parts));
  const double motions = static_cast<double>(moving_vertices) * static_cast<double>(report.contact_steps);
  if (static_cast<double>(report.reverted_vertices) >= std::max(fewest_cuts, told_share_of_cuts * motions))
    told.push_back(
        fmt::format("motions of vertices were cut short {} times, because they could not be proven to meet nothing: the bodies "
                    "move too far in a step, or are pressed too hard; try a larger gap, stiffer bodies or {}{}",
                    report.reverted_vertices, shorter_steps_in_contact(report),
                    precision == 32 ? ", or --precision 64, whose proofs fail more rarely" : ""));
  return told;
}

// Where bodies must stay apart, the count is by positions in fp64. The device's would have pairs that are nearer than fp32 tells.
std::uint64_t intersecting_pairs(const PreparedRun& run) {
  if (!meets_by_impulses(*run.simulation)) return run.simulation->intersections().pairs;
  return count_touching_pairs(run.start.model, run.simulation->state().world_positions(run.start.model));
}

std::vector<std::string> contact_troubles_of(const RunStatus& status) {
  if (!meets_by_impulses(*status.run.simulation)) return {};
  std::uint64_t moving_vertices = 0;
  for (const ModelBody& body : status.run.start.model.bodies) moving_vertices += body.is_rigid() ? 0 : body.vertex_count;
  std::vector<std::string> told = contact_troubles_of(status.report, moving_vertices, status.run.device->precision());
  for (const ScriptReport& script : status.report.response.scripts)
    if (script.waits > 0)
      told.push_back(fmt::format("body \"{}\" waited {} times for what stood in its way, and is {:.3g} s late",
                                 status.run.start.model.bodies[script.body].name, script.waits, script.waited));
  return told;
}

std::vector<std::string> cluster_troubles_of(const RunStatus& status) {
  constexpr double told_excess = 3;
  std::vector<std::string> told;
  if (!status.report.clusters) return told;
  if (const double excess = status.report.clusters->largest_excess; excess > told_excess)
    told.push_back(
        fmt::format("forces of \"{}\" were off by {:.3g} times its force_tolerance at a check, and maybe for some steps before; "
                    "try forces = \"direct\"{}",
                    status.run.start.model.bodies[status.report.clusters->worst_body].name, excess,
                    status.report.adaptive ? "" : ", or a tolerance for steps, which brings more checks"));
  for (const std::uint32_t b : status.report.clusters->direct) {
    const ModelBody& body = status.run.start.model.bodies[b];
    told.push_back(
        fmt::format("\"{}\" went over to sums of all its springs, because no lists of clusters met its force_tolerance of "
                    "{:.3g}, they had changed too often, or there was no room for more; that takes longer, and a larger "
                    "tolerance or damping may avoid it",
                    body.name, force_tolerance_of(body)));
  }
  return told;
}

Summary summary_of(const RunStatus& status) {
  const auto& [options, run, progress, report] = status;
  const RunTimes& times = progress.times;
  Summary s;
  s.scene = run.scene.file.string();
  s.device = {name_of(run.device->info().kind), run.device->info().name};
  s.precision = run.device->precision();
  s.threads = run.device->info().threads;
  s.ranks = ranks_of(run);
  s.integrator = run.plan.integrator->name;
  if (const auto& adaptive = report.adaptive)
    s.adaptive = {*run.plan.tolerance,     report.steps,          adaptive->rejected, adaptive->rejected_in_contact,
                  adaptive->smallest_step, adaptive->largest_step};
  else
    s.time_step = run.plan.time_step;
  s.steps = report.steps;
  s.simulated_seconds = report.time;
  s.wall_seconds = times.stepping.seconds();
  s.steps_per_second = report.steps == 0 ? 0 : static_cast<double>(report.steps) / times.stepping.seconds();
  s.energy = {progress.first.energy(), progress.latest.energy(), {}};
  if (run.plan.damping_law == DampingLaw::none && report.contact_steps == 0)
    s.energy.max_drift = progress.largest_drift / std::max(progress.most_in_motion, smallest_energy(run.start.model));
  s.contacts = {.steps = report.contact_steps,
                .pairs_max = report.contact_pairs_max,
                .reverted_vertices = report.reverted_vertices,
                .substeps = report.substeps,
                .held_parts = report.held_parts,
                .energy_given = report.response.energy_given,
                .energy_taken = report.response.energy_taken,
                .friction_work = report.response.friction_work,
                .work_of_scripts = report.response.work_of_scripts};
  for (const ScriptReport& script : report.response.scripts)
    s.scripts.push_back({run.start.model.bodies[script.body].name, script.time, script.waited, script.waits});
  if (const auto& clusters = report.clusters) {
    s.clusters = {{}, clusters->lists_made, run.simulation->energy_changed_by_lists(), {}};
    if (clusters->checks > 0) s.clusters->largest_error = clusters->largest_error;
    for (const std::uint32_t body : clusters->direct) s.clusters->direct.push_back(run.start.model.bodies[body].name);
  }
  s.energy.slept = report.energy_slept;
  s.bodies_asleep = report.bodies_asleep;
  s.non_finite = report.breakdown && !report.breakdown->is_finite;
  if (s.non_finite) s.energy.final = std::nan("");  // a sum over a non-finite state could still be finite
  if (!report.breakdown) s.final_intersecting_pairs = intersecting_pairs(run);
  s.interrupted = is_interrupted();
  s.work = {report.force_evaluations, report.pair_interactions, report.nodes_refitted,
            report.node_tests,        report.triangle_tests,    report.clusters ? report.clusters->checks : 0};
  s.skipped = {{"force_evaluations", report.forces_skipped}, {"bodies_at_rest", report.steps_at_rest},
               {"bodies_asleep", report.steps_asleep},       {"quiet_steps", report.quiet_steps},
               {"body_pairs", report.body_pairs_skipped},    {"tree_refits", report.refits_skipped}};
  s.timings_ms = {{"load", 1e3 * times.loading.seconds()},
                  {"build", 1e3 * times.building.seconds()},
                  {"step", 1e3 * times.stepping.seconds()},
                  {"measure", 1e3 * times.measuring.seconds()},
                  {"frames", 1e3 * times.writing.seconds()}};
  if (!options.checkpoint.empty()) s.timings_ms.emplace_back("checkpoints", 1e3 * times.saving.seconds());
  for (const auto& [pass, seconds] : run.simulation->pass_seconds())
    s.pass_timings_ms.emplace_back(std::string(pass), 1e3 * seconds);
  s.warnings = run.warnings;
  for (std::string& trouble : contact_troubles_of(status)) s.warnings.push_back(std::move(trouble));
  for (std::string& trouble : cluster_troubles_of(status)) s.warnings.push_back(std::move(trouble));
  if (const auto what = instability_of(status)) s.warnings.push_back(*what);
  s.version = version();
  return s;
}

void show_beginning(const RunStatus& status) {
  const auto& [options, run, progress, report] = status;
  fmt::print("going on with {} at step {}, into {}\n", run.scene.file.string(), report.steps, folder_of(options).string());
  std::fflush(stdout);  // the next output may come hours later
}

void show_progress(const RunStatus& status) {
  const auto& [options, run, progress, report] = status;
  const RunTimes& times = progress.times;
  if (isatty(fileno(stderr)) == 0) return;
  const bool adapts = report.adaptive.has_value();
  const double done =
      adapts ? report.time / run.plan.duration : static_cast<double>(report.steps) / static_cast<double>(run.plan.steps);
  const std::string parts = report.substeps > 0 ? fmt::format(" in {} parts", report.steps + report.substeps) : "";
  fmt::print(stderr, "\r{}  step {}{}{}  {:.1f} steps/s ", progress_bar(done), report.steps,
             adapts ? "" : fmt::format("/{}", run.plan.steps), parts,
             static_cast<double>(report.steps) / times.stepping.seconds());
  if (is_interrupted() || report.breakdown || done == 1) fmt::print(stderr, "\n");
}

void show_end(const RunStatus& status) {
  const auto& [options, run, progress, report] = status;
  const RunTimes& times = progress.times;
  fmt::print("{}{} steps of {} by {} in {:.2f} s ({:.1f} steps/s) on {} ({}){}\n", is_interrupted() ? "interrupted after " : "",
             report.steps, length_of_steps(run.plan, report), run.plan.integrator->name, times.stepping.seconds(),
             report.steps == 0 ? 0.0 : static_cast<double>(report.steps) / times.stepping.seconds(),
             name_of(run.device->info().kind), run.device->info().name,
             ranks_of(run) > 1 ? fmt::format(", {} ranks", ranks_of(run)) : "");
  const double beside = times.measuring.seconds() + times.writing.seconds() + times.saving.seconds();
  if (beside > 0.1 && 9 * beside > times.stepping.seconds())  // over a tenth of the whole
    fmt::print("besides stepping: {:.2f} s for measuring the state and {:.2f} s for frames{}\n", times.measuring.seconds(),
               times.writing.seconds(),
               !options.checkpoint.empty() ? fmt::format(" and {:.2f} s for checkpoints", times.saving.seconds()) : "");
  fmt::print("contacts in {} {}, at most {} {} at once\n", report.contact_steps, report.substeps > 0 ? "parts of steps" : "steps",
             report.contact_pairs_max,
             find_response(run.scene.collision.response).gives_impulses ? "impulses" : "triangle pairs");
  if (const ResponseReport& contacts = report.response; contacts.energy_taken > 0 || contacts.energy_given > 0)
    fmt::print("contacts took {:.4g} J{}, and gave {:.4g} J{}\n", contacts.energy_taken,
               contacts.friction_work > 0 ? fmt::format(", of which friction {:.4g} J", contacts.friction_work) : "",
               contacts.energy_given,
               contacts.scripts.empty() ? "" : fmt::format("; scripted bodies gave {:.4g} J", contacts.work_of_scripts));
  if (report.clusters) fmt::print("{}\n", told_checks(*report.clusters));
  if (options.timings && report.steps > 0) show_timings(*run.simulation, report.steps);
  fmt::print("summary: {}\n", (folder_of(options) / summary_name).string());
}

}  // namespace pliant
