#include "bench/common/report_parts.hpp"

#include <nlohmann/json.hpp>

namespace pliant::bench {
namespace {

template <class Value>
Json value_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json machine_json(const Machine& machine) {
  return {{"version", machine.version},         {"commit", machine.commit},    {"cpu", machine.cpu},
          {"cpu_threads", machine.cpu_threads}, {"gpu", or_null(machine.gpu)}, {"driver", or_null(machine.driver)},
          {"compiler", machine.compiler},       {"date", machine.date}};
}

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string lines_of(const Json& json) {
  if (!json.is_array() || json.empty()) return line_of(json);
  std::string lines;
  for (const Json& element : json) lines += (lines.empty() ? "[\n    " : ",\n    ") + line_of(element);
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

Json threads_json(const std::string& device, unsigned threads) { return device == "gpu" ? Json(nullptr) : Json(threads); }

Json or_null(const std::optional<double>& value) { return value_or_null(value); }
Json or_null(const std::optional<std::string>& value) { return value_or_null(value); }

std::string text_of(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items())
    text += (text.empty() ? "{\n  " : ",\n  ") + line_of(key) + ": " + lines_of(value);
  return text + "\n}\n";
}

}  // namespace pliant::bench
