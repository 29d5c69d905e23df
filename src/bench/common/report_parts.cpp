#include "bench/common/report_parts.hpp"

#include <utility>

namespace pliant::bench {
namespace {

Json machine_json(const Machine& machine) {
  return {{"version", machine.version},         {"commit", machine.commit}, {"cpu", machine.cpu},
          {"cpu_threads", machine.cpu_threads}, {"gpu", machine.gpu},       {"driver", machine.driver},
          {"compiler", machine.compiler},       {"date", machine.date}};
}

std::string lines_of(const Json& json) {
  const auto* elements = std::get_if<Json::Array>(&json.value());
  if (elements == nullptr || elements->empty()) return json.text();
  std::string lines;
  for (const Json& element : *elements) lines += (lines.empty() ? "[\n    " : ",\n    ") + element.text();
  return lines + "\n  ]";
}

}  // namespace

Json options_json(const Selection& devices, bool quick) {
  return {{"cpu", devices.cpu},
          {"gpu", devices.gpu},
          {"gpu_index", devices.gpu_index},
          {"threads", devices.threads},
          {"quick", quick}};
}

Json suite_json(const char* suite, const Json& options, bool interrupted, const Machine& machine) {
  return {{"suite", suite}, {"options", options}, {"interrupted", interrupted}, {"machine", machine_json(machine)}};
}

Json results_json(const char* suite, const Machine& machine, const Json& options, bool interrupted, Json rows,
                  const std::vector<std::string>& notes) {
  Json file = suite_json(suite, options, interrupted, machine);
  file.add("rows", std::move(rows));
  file.add("notes", notes);
  return file;
}

std::string threads_text(DeviceKind device, unsigned threads) {
  return device == DeviceKind::gpu ? "-" : std::to_string(threads);
}

Json threads_json(DeviceKind device, unsigned threads) { return device == DeviceKind::gpu ? Json(nullptr) : Json(threads); }

std::string text_of(const Json& object) {
  std::string text;
  for (const auto& [key, value] : std::get<Json::Object>(object.value()))
    text += (text.empty() ? "{\n  " : ",\n  ") + Json(key).text() + ": " + lines_of(value);
  return text + "\n}\n";
}

}  // namespace pliant::bench
