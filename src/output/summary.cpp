#include "output/summary.hpp"

#include "core/json.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

template <class Value>
Json object(const std::vector<std::pair<std::string, Value>>& entries) {
  Json json = Json::object();
  for (const auto& [name, value] : entries) json.add(name, value);
  return json;
}

Json device_json(const Summary& summary) { return {{"kind", summary.device.kind}, {"name", summary.device.name}}; }

Json adaptive_json(const Summary& summary) {
  if (!summary.adaptive) return nullptr;
  const auto& [tolerance, accepted, rejected, rejected_in_contact, smallest_step, largest_step] = *summary.adaptive;
  return {{"tolerance", tolerance},         {"accepted", accepted},
          {"rejected", rejected},           {"rejected_in_contact", rejected_in_contact},
          {"smallest_step", smallest_step}, {"largest_step", largest_step}};
}

Json energy_json(const Summary& summary) {
  const auto& [initial, final, max_drift, slept] = summary.energy;
  return {{"initial", initial}, {"final", final}, {"max_drift", max_drift}, {"slept", slept}};
}

Json contacts_json(const Summary& summary) {
  const auto& [steps, pairs_max, reverted_vertices, substeps, held_parts, energy_given, energy_taken, friction_work,
               work_of_scripts] = summary.contacts;
  return {{"steps", steps},
          {"pairs_max", pairs_max},
          {"reverted_vertices", reverted_vertices},
          {"substeps", substeps},
          {"held_parts", held_parts},
          {"energy_given", energy_given},
          {"energy_taken", energy_taken},
          {"friction_work", friction_work},
          {"work_of_scripts", work_of_scripts}};
}

Json scripts_json(const Summary& summary) {
  Json json = Json::object();
  for (const auto& [body, time, waited, waits] : summary.scripts)
    json.add(body, Json{{"time", time}, {"waited", waited}, {"waits", waits}});
  return json;
}

Json clusters_json(const Summary& summary) {
  if (!summary.clusters) return nullptr;
  const auto& [largest_error, lists_made, energy_change, direct] = *summary.clusters;
  return {{"largest_error", largest_error}, {"lists_made", lists_made}, {"energy_change", energy_change}, {"direct", direct}};
}

Json work_json(const Summary& summary) {
  const auto& [force_evaluations, pair_interactions, nodes_refitted, node_tests, triangle_tests, cluster_checks] = summary.work;
  return {{"force_evaluations", force_evaluations}, {"pair_interactions", pair_interactions},
          {"nodes_refitted", nodes_refitted},       {"node_tests", node_tests},
          {"triangle_tests", triangle_tests},       {"cluster_checks", cluster_checks}};
}

Json timings_json(const Summary& summary) {
  Json json = object(summary.timings_ms);
  if (!summary.pass_timings_ms.empty()) json.add("passes", object(summary.pass_timings_ms));
  return json;
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  const Json json = {{"scene", summary.scene},
                     {"device", device_json(summary)},
                     {"precision", summary.precision},
                     {"threads", summary.threads},
                     {"ranks", summary.ranks},
                     {"integrator", summary.integrator},
                     {"time_step", summary.time_step},
                     {"adaptive", adaptive_json(summary)},
                     {"steps", summary.steps},
                     {"simulated_seconds", summary.simulated_seconds},
                     {"wall_seconds", summary.wall_seconds},
                     {"steps_per_second", summary.steps_per_second},
                     {"energy", energy_json(summary)},
                     {"contacts", contacts_json(summary)},
                     {"scripts", scripts_json(summary)},
                     {"clusters", clusters_json(summary)},
                     {"bodies_asleep", summary.bodies_asleep},
                     {"final_intersecting_pairs", summary.final_intersecting_pairs},
                     {"non_finite", summary.non_finite},
                     {"interrupted", summary.interrupted},
                     {"warnings", summary.warnings},
                     {"work", work_json(summary)},
                     {"skipped", object(summary.skipped)},
                     {"timings_ms", timings_json(summary)},
                     {"version", summary.version}};
  WholeFile file(path);
  file.write(json.text(2));
  file.write("\n");
  file.close();
}

}  // namespace pliant
