#include "output/summary.hpp"

#include <nlohmann/json.hpp>

#include "output/file.hpp"

namespace pliant {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json object(const std::vector<std::pair<std::string, Value>>& entries) {
  Json json = Json::object();
  for (const auto& [name, value] : entries) json[name] = value;
  return json;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
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
  const auto& [initial, final, max_drift] = summary.energy;
  return {{"initial", initial}, {"final", final}, {"max_drift", or_null(max_drift)}};
}

Json contacts_json(const Summary& summary) {
  const auto& [steps, pairs_max, reverted_vertices] = summary.contacts;
  return {{"steps", steps}, {"pairs_max", pairs_max}, {"reverted_vertices", reverted_vertices}};
}

Json work_json(const Summary& summary) {
  const auto& [force_evaluations, pair_interactions, nodes_refitted, node_tests, triangle_tests] = summary.work;
  return {{"force_evaluations", force_evaluations},
          {"pair_interactions", pair_interactions},
          {"nodes_refitted", nodes_refitted},
          {"node_tests", node_tests},
          {"triangle_tests", triangle_tests}};
}

Json timings_json(const Summary& summary) {
  Json json = object(summary.timings_ms);
  if (!summary.pass_timings_ms.empty()) json["passes"] = object(summary.pass_timings_ms);
  return json;
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  const Json json = {{"scene", summary.scene},
                     {"device", device_json(summary)},
                     {"precision", summary.precision},
                     {"threads", summary.threads},
                     {"integrator", summary.integrator},
                     {"time_step", or_null(summary.time_step)},
                     {"adaptive", adaptive_json(summary)},
                     {"steps", summary.steps},
                     {"simulated_seconds", summary.simulated_seconds},
                     {"wall_seconds", summary.wall_seconds},
                     {"steps_per_second", summary.steps_per_second},
                     {"energy", energy_json(summary)},
                     {"contacts", contacts_json(summary)},
                     {"final_intersecting_pairs", or_null(summary.final_intersecting_pairs)},
                     {"non_finite", summary.non_finite},
                     {"interrupted", summary.interrupted},
                     {"warnings", summary.warnings},
                     {"work", work_json(summary)},
                     {"skipped", object(summary.skipped)},
                     {"timings_ms", timings_json(summary)},
                     {"version", summary.version}};
  WholeFile file(path);
  file.write(json.dump(2, ' ', false, Json::error_handler_t::replace));  // replace: a path need not be UTF-8
  file.write("\n");
  file.close();
}

}  // namespace pliant
